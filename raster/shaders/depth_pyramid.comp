// One level of the depth pyramid from the level before.
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform sampler2D finer_levels;
layout(r32f) writeonly uniform image2D level_image;
uniform int level;
#include "depth_pyramid.glsl"

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, imageSize(level_image)))) return;
  ivec2 source = source_texel(texel, textureSize(finer_levels, level - 1));
  imageStore(level_image, texel, vec4(texelFetch(finer_levels, source, level - 1).r));
}
