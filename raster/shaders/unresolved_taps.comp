// Lists the taps that are wrong at some bias of the axes and lie on another surface by the two-plane rule:
// UnresolvedTap of techniques/shadow/causes.h, in any order. With OF_LIT those of pixels that are lit in the truth,
// otherwise those of blocked ones.
#include "cause.glsl"
#include "pixel_list.glsl"
#include "response.glsl"
layout(local_size_x = LIST_GROUP_SIZE) in;
layout(std430) restrict buffer UnresolvedTaps {
  uint unresolved_count;
  uint words[];
};

void main() {
  uint index = first_pixel + gl_GlobalInvocationID.x;
  if (index >= end_pixel) return;
  ivec2 pixel = listed_pixel(index);
  bool is_lit_in_truth = OF_LIT != 0;
  if (is_lit_in_reference(pixel) != is_lit_in_truth) return;
  float bias = is_lit_in_truth ? min_bias : max_bias;
  float factor = is_lit_in_truth ? min_slope : max_slope;
  uvec2 id = texelFetch(ids, pixel, 0).rg;
  Lookup surfel = look_up(pixel);
  Pattern pattern = make_pattern(surfel, pixel);
  Facet own = fetch_facet(id);
  for (int i = 0; i < tap_count; ++i) {
    WeightedTap tap = filter_tap(surfel.receiver, pattern, i);
    float flip = flip_bias(tap.tap.critical_bias, surfel.slope, factor);
    if (tap.weight == 0u || is_lit_at(bias, surfel.bias_unit, flip) == is_lit_in_truth) continue;
    int cause = cause_of(tap.tap, is_lit_in_truth, surfel.receiver, id, own);
    if (cause != (is_lit_in_truth ? CAUSE_FALSE_OCCLUSION : CAUSE_PETER_PANNING)) continue;
    uint word = UNRESOLVED_WORDS * atomicAdd(unresolved_count, 1u);
    uvec2 sample_id = texelFetch(shadow_ids, tap.tap.texel, 0).rg;
    words[word] = uint(pixel.x) | uint(pixel.y) << 16u;
    words[word + 1u] = uint(tap.tap.texel.x) | uint(tap.tap.texel.y) << 16u;
    words[word + 2u] = uint(tap.tap.texel.z);
    words[word + 3u] = tap.weight;
    words[word + 4u] = floatBitsToUint(tap.tap.critical_bias);
    words[word + 5u] = floatBitsToUint(surfel.slope);
    words[word + 6u] = floatBitsToUint(surfel.bias_unit);
    words[word + 7u] = sample_id.x;
    words[word + 8u] = sample_id.y;
  }
}
