// What the AO methods of techniques/ao/*.glsl read.
#include "view.glsl"
uniform usampler2D ids;
uniform sampler2D position_depth;
uniform sampler2D linear_depth;
uniform sampler2D geometric_normal;
#ifdef AO_BENT_NORMAL
layout(rgba32f) writeonly uniform image2D bent_normals;
#else
layout(r32f) writeonly uniform image2D ao_image;
#endif
layout(std430) readonly buffer Noise { vec4 noise[]; };
uniform int noise_size;

float depth_at(ivec2 pixel) { return texelFetch(linear_depth, pixel, 0).r; }
#include "screen.glsl"
