// Base colour and alpha. The alpha test must agree with the ray tracer's.
#include "texture_sampling.glsl"
uniform vec4 base_color_factor;
uniform ivec2 base_color_wrap;
uniform int material_textures;  // one bit each, in the order of texture_members (scenes/material.h)
uniform sampler2D base_color_texture;

vec4 base_color_at(vec2 texcoord, bool decode) {
  if ((material_textures & 1) == 0) return base_color_factor;
  return base_color_factor * sample_bilinear(base_color_texture, base_color_wrap, texcoord, decode);
}
