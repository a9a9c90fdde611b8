// Which points of masked geometry exist, asked for every hit on it. For raytrace/*.cpp and tests.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenes/scene.h"

namespace umbrameter {

/// The alpha test of a material. Where the texels about a point all say the same, two bits tell so: most hits on leaves
/// and fences need no more, and those stay in the processor's nearest cache where texels do not.
class AlphaMask {
 public:
  AlphaMask(const Scene& scene, const Material& material);

  /// Whether alpha_at() of the texture coordinate is ≥ Material::alpha_cutoff: the same for every coordinate.
  bool is_there(vec2 texcoord) const;

 private:
  enum class Answer : std::uint8_t { open, there, mixed };
  Answer answer_near(std::size_t column, std::size_t row) const;
  Answer answer(float least, float most) const;

  static constexpr std::size_t answers_in_byte = 4;
  static unsigned shift_of(std::size_t column) { return static_cast<unsigned>(column % answers_in_byte) * 2u; }

  const Scene& scene_;
  const Material& material_;
  const Texture* texture_;  // null without one
  std::size_t row_size_ = 0;
  std::vector<std::uint8_t> answers_;  // of all points whose footprint begins at a texel; rows of whole bytes
};

/// Of a mesh whose material is masked.
class MeshMask {
 public:
  MeshMask(const Mesh& mesh, const AlphaMask& mask);

  /// Whether the point of a triangle exists. Barycentric coordinates are of its second and third corner.
  bool is_there(std::uint32_t triangle, vec2 barycentric) const {
    const auto& [a, b, c] = texcoords_[triangle];
    return mask_.is_there((1.0f - barycentric.x - barycentric.y) * a + barycentric.x * b + barycentric.y * c);
  }

 private:
  std::vector<std::array<vec2, 3>> texcoords_;  // of each triangle's corners: one place in memory instead of four
  const AlphaMask& mask_;
};

}  // namespace umbrameter
