// The cause of each wrong tap, for the pixels that have any.
#include "surfel_lookup.glsl"
#include "own_surface.glsl"
#include "wrong_pixels.glsl"
layout(local_size_x = LIST_GROUP_SIZE) in;
layout(binding = IMAGE_CLASSES, rgba32f) writeonly uniform image2D classes_image;
const int acne = 0;
const int false_occlusion = 1;
const int peter_panning = 2;
const int leak = 3;

void main() {
  if (gl_GlobalInvocationID.x >= wrong_count) return;
  uint packed_pixel = wrong_pixels[gl_GlobalInvocationID.x];
  ivec2 pixel = ivec2(packed_pixel & 0xffffu, packed_pixel >> 16u);
  uvec2 id = texelFetch(ids, pixel, 0).rg;
  Lookup surfel = look_up(pixel);
  bool is_lit_in_truth = is_truly_lit(pixel);
  Facet own = fetch_facet(id);
  ivec4 wrong = ivec4(0);
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      Tap tap = fetch_tap(surfel.receiver, ivec2(x, y));
      bool says_lit = is_lit(tap.critical_bias, surfel.slope);
      if (says_lit == is_lit_in_truth) continue;
      // Only a sample nearer to the light can have been erased by the bias.
      bool is_in_front = tap.has_blocker && (!says_lit || tap.critical_bias > 0.0);
      if (is_in_front) {
        is_in_front = !is_own(surfel.receiver, id, own, tap.texel, texelFetch(shadow_ids, tap.texel, 0).rg);
      }
      wrong[says_lit ? (is_in_front ? peter_panning : leak) : (is_in_front ? false_occlusion : acne)] += 1;
    }
  }
  imageStore(classes_image, pixel, vec4(wrong) / float(taps * taps));
}
