// What a material is at a texture coordinate: factors times textures. raster/shaders/material.glsl computes the same.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/math.h"
#include "scenes/scene.h"

namespace umbrameter {

/// The textures of a material. The first has the alpha that makes holes; images of the others are only for shading.
inline constexpr std::array<std::optional<std::uint32_t> Material::*, 4> texture_members = {
    &Material::base_color_texture, &Material::metallic_roughness_texture, &Material::specular_texture,
    &Material::specular_color_texture};

/// Base colour texture, or null where the material has none or an empty one.
const Texture* texture_of(const Scene& scene, const Material& material);

/// Bilinear base-colour alpha at a texture coordinate, factor included, 0 to 1 (glTF 2.0, section 3.9.4).
/// The alpha test of both sides is: a point exists where this is ≥ Material::alpha_cutoff.
float alpha_at(const Scene& scene, const Material& material, vec2 texcoord);

/// Linear base colour and alpha at a texture coordinate, factor included; filtered after decoding sRGB.
vec4 base_color_at(const Scene& scene, const Material& material, vec2 texcoord);

/// What shading reads of a material, all of it from 0 to 1.
struct SurfaceMaterial {
  vec3 base_color{0.0f};  ///< linear
  float metallic = 0.0f;
  float roughness = 0.0f;  ///< perceptual
  vec3 specular{0.0f};     ///< linear reflectance at normal incidence, F0 of the glTF material
};

/// F0 of the dielectric part by the factors alone; above 1 where they are out of bounds.
vec3 dielectric_specular(const Material& material);

/// glTF 2.0, appendix B.3, and KHR_materials_specular: specular is a mix of the dielectric's F0 and the base colour,
/// by metallic.
SurfaceMaterial surface_material_at(const Scene& scene, const Material& material, vec2 texcoord);

}  // namespace umbrameter
