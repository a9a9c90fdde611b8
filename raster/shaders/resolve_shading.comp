// Adds ambient light to the light buffer.
#include "stored_gbuffer.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform usampler2D ids;
uniform sampler2D light_buffer;
uniform sampler2D ao;
layout(rgba32f) writeonly uniform image2D radiance;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  vec3 sum = texelFetch(light_buffer, pixel, 0).rgb;
  if (texelFetch(ids, pixel, 0).r != NO_ID) {
    sum += texelFetch(ao, pixel, 0).r * reflect_ambient(surface_at(pixel), ambient);
  }
  imageStore(radiance, pixel, vec4(sum, 1));
}
