// What shading reads of a material at a texture coordinate, as scenes/material.h.
#include "base_color.glsl"
uniform vec2 metallic_roughness_factors;
uniform vec3 dielectric_specular;

struct SurfaceMaterial {
  vec3 base_color;
  float metallic;
  float roughness;
  vec3 specular;
};

// `base_color` is base_color_at() of the texture coordinate, decoded.
SurfaceMaterial surface_material_at(vec2 texcoord, vec3 base_color) {
  SurfaceMaterial surface;
  surface.base_color = clamp(base_color, 0.0, 1.0);
  surface.metallic = metallic_roughness_factors.x;
  surface.roughness = metallic_roughness_factors.y;
  surface.specular = min(mix(dielectric_specular, surface.base_color, surface.metallic), 1.0);
  return surface;
}
