// What the AO methods of techniques/ao/*.glsl read.
#include "view.glsl"
uniform usampler2D ids;
uniform sampler2D position_depth;
uniform sampler2D linear_depth;
uniform sampler2D geometric_normal;
layout(r32f) writeonly uniform image2D ao_image;
layout(std430) readonly buffer Noise { vec4 noise[]; };
uniform int noise_size;

float depth_at(ivec2 pixel) { return texelFetch(linear_depth, pixel, 0).r; }
#include "screen.glsl"
