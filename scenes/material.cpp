#include "scenes/material.h"

#include <array>
#include <cmath>
#include <cstdint>

#include "scenes/texel_place.h"

namespace umbrameter {
namespace {

// The four texels about a texture coordinate and the weight of the second in each direction.
struct Footprint {
  std::array<std::size_t, 4> index{};
  float right = 0.0f;
  float down = 0.0f;
};

Footprint footprint(const Texture& texture, vec2 texcoord) {
  const TexelPlace place = texel_place(texture, texcoord);
  const auto width = static_cast<std::size_t>(texture.texels.width);
  const std::array<std::size_t, 2> columns{column_of(texture, place.left), column_of(texture, place.left + 1)};
  const std::array<std::size_t, 2> rows{row_of(texture, place.top) * width, row_of(texture, place.top + 1) * width};
  return {{rows[0] + columns[0], rows[0] + columns[1], rows[1] + columns[0], rows[1] + columns[1]},
          place.right,
          place.down};
}

template <class T>
T bilinear(const std::array<T, 4>& values, float right, float down) {
  const T upper = values[0] + (values[1] - values[0]) * right;
  const T lower = values[2] + (values[3] - values[2]) * right;
  return upper + (lower - upper) * down;
}

// IEC 61966-2-1.
float linear_from_srgb(std::uint8_t byte) {
  const float encoded = static_cast<float>(byte) / 255.0f;
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

const Texture* find_texture(const Scene& scene, const std::optional<std::uint32_t>& index) {
  if (!index) return nullptr;
  const Texture& texture = scene.textures.at(*index);
  return texture.texels.empty() ? nullptr : &texture;
}

enum class Encoding : int { linear, srgb };

// The texture's linear value, 1 without one.
vec4 sample(const Scene& scene, const std::optional<std::uint32_t>& index, vec2 texcoord, Encoding encoding) {
  const Texture* texture = find_texture(scene, index);
  if (texture == nullptr) return vec4(1.0f);
  const Footprint taps = footprint(*texture, texcoord);
  std::array<vec4, 4> values{};
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::u8vec4& texel = texture->texels[taps.index[i]];
    values[i] = vec4(texel) / 255.0f;
    if (encoding == Encoding::linear) continue;
    for (int c = 0; c < 3; ++c) values[i][c] = linear_from_srgb(texel[c]);
  }
  return bilinear(values, taps.right, taps.down);
}

}  // namespace

const Texture* texture_of(const Scene& scene, const Material& material) {
  return find_texture(scene, material.base_color_texture);
}

float alpha_at(const Scene& scene, const Material& material, vec2 texcoord) {
  const Texture* texture = texture_of(scene, material);
  if (texture == nullptr) return material.base_color.w;
  const Footprint taps = footprint(*texture, texcoord);
  std::array<float, 4> alpha{};
  for (std::size_t i = 0; i < 4; ++i) alpha[i] = static_cast<float>(texture->texels[taps.index[i]].w) / 255.0f;
  return material.base_color.w * bilinear(alpha, taps.right, taps.down);
}

vec4 base_color_at(const Scene& scene, const Material& material, vec2 texcoord) {
  return material.base_color * sample(scene, material.base_color_texture, texcoord, Encoding::srgb);
}

vec3 dielectric_specular(const Material& material) {
  return dielectric_f0 * material.specular * material.specular_color;
}

SurfaceMaterial surface_material_at(const Scene& scene, const Material& material, vec2 texcoord) {
  const vec4 metal = sample(scene, material.metallic_roughness_texture, texcoord, Encoding::linear);
  const float strength = sample(scene, material.specular_texture, texcoord, Encoding::linear).w;
  const vec3 tint(sample(scene, material.specular_color_texture, texcoord, Encoding::srgb));
  SurfaceMaterial surface;
  surface.base_color = glm::clamp(vec3(base_color_at(scene, material, texcoord)), 0.0f, 1.0f);
  surface.metallic = material.metallic * metal.z;
  surface.roughness = material.roughness * metal.y;
  const vec3 dielectric = dielectric_specular(material) * strength * tint;
  surface.specular = glm::min(glm::mix(dielectric, surface.base_color, surface.metallic), vec3(1.0f));
  return surface;
}

}  // namespace umbrameter
