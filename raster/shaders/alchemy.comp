#include "ao_surfel.glsl"
float depth_at_level(ivec2 texel, int level) { return texelFetch(linear_depth, texel, level).r; }
#include "depth_pyramid.glsl"
#include "alchemy.glsl"
layout(std140) uniform Settings { AlchemySettings settings; };
#include "ao_method.glsl"
