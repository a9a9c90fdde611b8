// One axis of a Gaussian or bilateral blur of ambient occlusion: AoBlurTaps of techniques/ao/blur.h. Background does not
// contribute, and stays 1.
#include "ao_resolution.glsl"
#include "edge_weight.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform usampler2D ids;
uniform sampler2D source;
layout(r32f) writeonly uniform image2D blurred;
uniform ivec2 axis;
uniform int first;
uniform int taps;
uniform float deviation;  // of the Gaussian, pixels

void main() {
  ivec2 size = textureSize(source, 0);
  ivec2 view_size = textureSize(ids, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  ivec2 surfel = surfel_pixel(pixel, view_size);
  if (texelFetch(ids, surfel, 0).r == NO_ID) {
    imageStore(blurred, pixel, vec4(1.0));
    return;
  }
  vec3 position = texelFetch(position_depth, surfel, 0).xyz;
  vec3 normal = texelFetch(geometric_normal, surfel, 0).xyz;
  float sum = 0.0;
  float weights = 0.0;
  for (int i = 0; i < taps; ++i) {
    ivec2 at = clamp(pixel + (first + i) * axis, ivec2(0), size - 1);
    ivec2 neighbour = surfel_pixel(at, view_size);
    if (texelFetch(ids, neighbour, 0).r == NO_ID) continue;
    float offset = float(first + i) / deviation;
    float weight = edge_weighted(exp(-0.5 * offset * offset), position, normal, neighbour);
    sum += weight * texelFetch(source, at, 0).r;
    weights += weight;
  }
  imageStore(blurred, pixel, vec4(weights > 0.0 ? sum / weights : texelFetch(source, pixel, 0).r));
}
