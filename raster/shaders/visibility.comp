// What the shadow map says of each surfel; with a truth, the list of the pixels that have wrong taps.
#include "surfel_lookup.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
layout(binding = IMAGE_VISIBILITY, r32f) writeonly uniform image2D visibility_image;
#if HAS_TRUTH
#include "wrong_pixels.glsl"
#endif

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(ids, 0)))) return;
  float visibility = 1.0;
  if (texelFetch(ids, pixel, 0).r != NO_ID) {
    visibility = 0.0;
    Lookup surfel = look_up(pixel);
    if (surfel.faces_light) {
      int lit = 0;
      for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
          if (is_lit(fetch_tap(surfel.receiver, ivec2(x, y)).critical_bias, surfel.slope)) ++lit;
        }
      }
      visibility = float(lit) / float(taps * taps);
#if HAS_TRUTH
      if (lit != (is_truly_lit(pixel) ? taps * taps : 0)) {
        uint index = atomicAdd(wrong_count, 1u);
        atomicMax(group_count.x, index / LIST_GROUP_SIZE + 1u);
        wrong_pixels[index] = uint(pixel.x) | uint(pixel.y) << 16u;
      }
#endif
    }
  }
  imageStore(visibility_image, pixel, vec4(visibility));
}
