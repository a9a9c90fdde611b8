// Computes the visibility of each surfel from the shadow map. With a truth, it also lists the pixels that have wrong
// taps.
#include "shadow_filter.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
layout(r32f) writeonly uniform image2D visibility_image;
#if HAS_TRUTH
#include "pixel_list.glsl"
#endif

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(ids, 0)))) return;
  float visibility = 1.0;
  if (texelFetch(ids, pixel, 0).r != NO_ID) {
    visibility = 0.0;
    Lookup surfel = look_up(pixel);
    if (surfel.faces_light) {
      uint lit = 0u;
      Pattern pattern = make_pattern(surfel, pixel);
#if FILTER_HARDENS
      visibility = hardened_visibility(surfel, pattern);
#else
      for (int i = 0; i < tap_count; ++i) {
        WeightedTap tap = filter_tap(surfel.receiver, pattern, i);
        if (is_lit(tap.tap.critical_bias, surfel)) lit += tap.weight;
      }
      visibility = float(double(lit) / double(weight_sum));
#if HAS_TRUTH
      if (reference_at(pixel) >= 0.0 && lit != (is_lit_in_reference(pixel) ? weight_sum : 0u)) append(pixel);
#endif
#endif
    }
  }
  imageStore(visibility_image, pixel, vec4(visibility));
}
