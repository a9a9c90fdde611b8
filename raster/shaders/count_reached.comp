// Counts for each light with a range the surfels in its sphere or cone.
#include "stored_gbuffer.glsl"
#include "lights.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform usampler2D ids;
layout(std430) restrict buffer Reached { uint reached[]; };

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size)) || texelFetch(ids, pixel, 0).r == NO_ID) return;
  vec3 position = position_at(pixel);
  for (int i = 0; i < light_count; ++i) {
    if (is_in_volume(position, lights[i])) atomicAdd(reached[i], 1u);
  }
}
