// The material at a texture coordinate; the counterpart of scenes/material.h.
#include "base_color.glsl"
uniform vec2 metallic_roughness_factors;
uniform vec3 dielectric_specular;
uniform ivec2 metallic_roughness_wrap;
uniform ivec2 specular_wrap;
uniform ivec2 specular_color_wrap;
uniform sampler2D metallic_roughness_texture;
uniform sampler2D specular_texture;
uniform sampler2D specular_color_texture;

struct SurfaceMaterial {
  vec3 base_color;
  float metallic;
  float roughness;
  vec3 specular;
};

// `base_color` is base_color_at() at this texture coordinate, decoded.
SurfaceMaterial surface_material_at(vec2 texcoord, vec3 base_color) {
  SurfaceMaterial surface;
  surface.base_color = clamp(base_color, 0.0, 1.0);
  vec2 metal = metallic_roughness_factors;
  vec3 dielectric = dielectric_specular;
  if ((material_textures & ~1) != 0) {
    if ((material_textures & 2) != 0) {
      metal *= sample_bilinear(metallic_roughness_texture, metallic_roughness_wrap, texcoord, false).bg;
    }
    if ((material_textures & 4) != 0) {
      dielectric *= sample_bilinear(specular_texture, specular_wrap, texcoord, false).a;
    }
    if ((material_textures & 8) != 0) {
      dielectric *= sample_bilinear(specular_color_texture, specular_color_wrap, texcoord, true).rgb;
    }
  }
  surface.metallic = metal.x;
  surface.roughness = metal.y;
  surface.specular = min(mix(dielectric, surface.base_color, surface.metallic), 1.0);
  return surface;
}
