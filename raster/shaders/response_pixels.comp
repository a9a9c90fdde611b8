// Lists the pixels that have a wrong tap at some bias of the axes.
#include "shadow_filter.glsl"
#include "pixel_list.glsl"
#include "response.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(ids, 0)))) return;
  if (texelFetch(ids, pixel, 0).r == NO_ID || !(reference_at(pixel) >= 0.0)) return;
  Lookup surfel = look_up(pixel);
  if (!surfel.faces_light) return;
  bool is_lit_in_truth = is_lit_in_reference(pixel);
#if LIT_ALONE
  if (!is_lit_in_truth) return;
#endif
  // The flip decreases as the slope factor grows. So a tap that is blocked at any bias is blocked at the smallest
  // constant and slope-scaled bias, and a tap that is lit at any bias is lit at the largest ones.
  float bias = is_lit_in_truth ? min_bias : max_bias;
  float factor = is_lit_in_truth ? min_slope : max_slope;
  Pattern pattern = make_pattern(surfel, pixel);
  bool is_wrong = false;
  for (int i = 0; i < tap_count; ++i) {
    WeightedTap tap = filter_tap(surfel.receiver, pattern, i);
    bool says_lit = is_lit_at(bias, surfel.bias_unit, flip_bias(tap.tap.critical_bias, surfel.slope, factor));
    is_wrong = is_wrong || (tap.weight > 0u && says_lit != is_lit_in_truth);
  }
  if (is_wrong) append(pixel);
}
