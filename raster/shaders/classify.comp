// Sums the weights of the wrong taps by cause, for the listed pixels.
#include "cause.glsl"
#include "pixel_list.glsl"
layout(local_size_x = LIST_GROUP_SIZE) in;
layout(rgba32ui) writeonly uniform uimage2D wrong_image;

void main() {
  uint index = first_pixel + gl_GlobalInvocationID.x;
  if (index >= end_pixel) return;
  ivec2 pixel = listed_pixel(index);
  uvec2 id = texelFetch(ids, pixel, 0).rg;
  Lookup surfel = look_up(pixel);
  Pattern pattern = make_pattern(surfel, pixel);
  bool is_lit_in_truth = is_lit_in_reference(pixel);
  Facet own = fetch_facet(id);
  uvec4 wrong = uvec4(0u);
  for (int i = 0; i < tap_count; ++i) {
    WeightedTap tap = filter_tap(surfel.receiver, pattern, i);
    if (tap.weight == 0u || is_lit(tap.tap.critical_bias, surfel) == is_lit_in_truth) continue;
    wrong[cause_of(tap.tap, is_lit_in_truth, surfel.receiver, id, own)] += tap.weight;
  }
  imageStore(wrong_image, pixel, wrong);
}
