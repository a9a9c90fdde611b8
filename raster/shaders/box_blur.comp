// One axis of a box blur of ambient occlusion: AoBlurTaps of techniques/ao/blur.h. Coordinates are clamped to the edge.
// The background stays 1.
#include "ao_resolution.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform usampler2D ids;
uniform sampler2D source;
layout(r32f) writeonly uniform image2D blurred;
uniform ivec2 axis;
uniform int first;
uniform int taps;
uniform int is_last;  // whether this is the last axis

void main() {
  ivec2 size = textureSize(source, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  float sum = 0.0;
  for (int i = 0; i < taps; ++i) {
    ivec2 at = clamp(pixel + (first + i) * axis, ivec2(0), size - 1);
    sum += texelFetch(source, at, 0).r;
  }
  bool is_background = is_last != 0 && texelFetch(ids, surfel_pixel(pixel, textureSize(ids, 0)), 0).r == NO_ID;
  imageStore(blurred, pixel, vec4(is_background ? 1.0 : sum / float(taps)));
}
