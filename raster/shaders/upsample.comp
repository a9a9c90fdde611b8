// Joint bilateral upsampling of ambient occlusion (J. Kopf, M. Cohen, D. Lischinski and M. Uyttendaele, Joint Bilateral
// Upsampling, SIGGRAPH 2007): bilinear weights, times those of edge_weight.glsl. Background does not contribute, and is 1.
#include "ao_resolution.glsl"
#include "edge_weight.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform usampler2D ids;
uniform sampler2D source;
layout(r32f) writeonly uniform image2D upsampled;

void main() {
  ivec2 view_size = textureSize(ids, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, view_size))) return;
  float result = 1.0;
  if (texelFetch(ids, pixel, 0).r != NO_ID) {
    vec3 position = texelFetch(position_depth, pixel, 0).xyz;
    vec3 normal = texelFetch(geometric_normal, pixel, 0).xyz;
    ivec2 size = ao_image_size(view_size);
    int row = view_size.y - 1 - pixel.y;  // from the top, as the blocks are
    ivec2 block = ivec2(pixel.x / 2, size.y - 1 - row / 2);
    ivec2 between = ivec2(pixel.x, row) % 2;  // 1: halfway to the next block on the right, or below
    // Sums of differences from one neighbour's value, so that equal values give that value exactly.
    float origin = 1.0;
    float sum = 0.0;
    float weights = 0.0;
    float nearest = 1e30;
    float nearest_value = 1.0;
    for (int i = 0; i < 4; ++i) {
      ivec2 offset = ivec2(i % 2, i / 2);
      if (any(greaterThan(offset, between))) continue;
      ivec2 at = block + ivec2(offset.x, -offset.y);
      if (at.x >= size.x || at.y < 0) continue;
      ivec2 neighbour = surfel_pixel(at, view_size);
      if (texelFetch(ids, neighbour, 0).r == NO_ID) continue;
      float value = texelFetch(source, at, 0).r;
      float apart = abs(above_tangent(position, normal, neighbour));
      if (apart < nearest) {
        nearest = apart;
        nearest_value = value;
      }
      // Bilinear weights of those that contribute are equal.
      float weight = edge_weighted(1.0, position, normal, neighbour);
      if (weights == 0.0) origin = value;
      sum += weight * (value - origin);
      weights += weight;
    }
    result = weights > 0.0 ? origin + sum / weights : nearest_value;
  }
  imageStore(upsampled, pixel, vec4(result));
}
