// One axis of a box blur of ambient occlusion. Coordinates are clamped to the edge. The background stays 1. A kernel
// with an even number of taps extends one pixel further to the left and up.
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
layout(binding = TEXTURE_IDS) uniform usampler2D ids;
layout(binding = TEXTURE_AO) uniform sampler2D source;
layout(binding = IMAGE_AO, r32f) writeonly uniform image2D blurred;
layout(location = UNIFORM_BLUR) uniform ivec4 blur;  // step x, step y, taps, whether this is the last axis

void main() {
  ivec2 size = textureSize(source, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  float sum = 0.0;
  for (int i = 0; i < blur.z; ++i) {
    ivec2 at = clamp(pixel + (i - blur.z / 2) * blur.xy, ivec2(0), size - 1);
    sum += texelFetch(source, at, 0).r;
  }
  bool is_background = blur.w != 0 && texelFetch(ids, pixel, 0).r == NO_ID;
  imageStore(blurred, pixel, vec4(is_background ? 1.0 : sum / float(blur.z)));
}
