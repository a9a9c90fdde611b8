// Lists the samples of each pixel that occlude at the smallest bias of an axis, with the number of biases at which they
// do: OccludingSample of techniques/ao/bias_response.h.
#include "ssao_sample.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
layout(std430) readonly buffer Biases { float biases[]; };  // ascending
layout(std430) writeonly buffer Counts { uint counts[]; };
layout(std430) writeonly buffer Occluding { uvec2 occluding[]; };
uniform int bias_count;
uniform float first_bias;
uniform float last_bias;
uniform int first_row;  // of these invocations, from the top of the image
uniform int end_row;

// The number of biases at which the sample occludes, which it does at the first.
uint count_biases(SsaoSample at) {
  if (occludes(at, last_bias)) return uint(bias_count);
  uint below = 1u;
  uint above = uint(bias_count) - 1u;
  while (below < above) {
    uint middle = (below + above) / 2u;
    if (occludes(at, biases[middle])) {
      below = middle + 1u;
    } else {
      above = middle;
    }
  }
  return below;
}

void main() {
  int row = int(gl_GlobalInvocationID.y);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.x, size.y - 1 - first_row - row);
  if (pixel.x >= size.x || first_row + row >= end_row) return;
  uint place = uint(row * size.x + pixel.x);
  uint count = 0u;
  if (texelFetch(ids, pixel, 0).r != NO_ID) {
    SsaoSurfel surfel = ssao_surfel(pixel);
    for (int i = 0; i < samples; ++i) {
      SsaoSample at = ssao_sample(surfel, i);
      if (!at.is_in_front || !occludes(at, first_bias)) continue;
      uint bits = uint(i) << 22 | count_biases(at);
      occluding[place * uint(samples) + count] = uvec2(bits, floatBitsToUint(occlusion_weight(surfel, at)));
      ++count;
    }
  }
  counts[place] = count;
}
