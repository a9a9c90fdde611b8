// The alpha test of masked geometry, which runs for every hit on it. For raytrace/*.cpp and tests.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/scene.h"

namespace umbrameter {

/// The alpha test of a material. Two bits per texel store its result wherever it is the same for all interpolated
/// values of a footprint. Most hits on leaves and fences need no more, and the bits fit into the cache.
class AlphaMask {
 public:
  AlphaMask(const Scene& scene, const Material& material);

  /// Whether alpha_at() of the texture coordinate is ≥ Material::alpha_cutoff.
  bool is_opaque(vec2 texcoord) const;

 private:
  enum class Coverage : std::uint8_t { transparent, opaque, mixed };
  Coverage coverage_from(std::size_t column, std::size_t row) const;
  Coverage coverage_between(float min_alpha, float max_alpha) const;

  static constexpr std::size_t texels_per_byte = 4;
  static unsigned shift_of(std::size_t column) { return static_cast<unsigned>(column % texels_per_byte) * 2u; }

  const Scene& scene_;
  const Material& material_;
  const Texture* texture_;              // null without one
  std::size_t row_bytes_ = 0;           // rows begin at whole bytes
  std::vector<std::uint8_t> coverage_;  // by the first texel of a footprint
};

/// A mesh whose material is masked.
struct MeshMask {
  const Mesh& mesh;
  const AlphaMask& mask;

  /// Whether the triangle is opaque at a point, given by the barycentric coordinates of the second and third corner.
  bool is_opaque(std::uint32_t triangle, vec2 barycentric) const {
    if (mesh.texcoords.empty()) return mask.is_opaque(vec2(0));
    const uvec3 v = mesh.triangles[triangle];
    return mask.is_opaque((1.0f - barycentric.x - barycentric.y) * mesh.texcoords[v.x] +
                          barycentric.x * mesh.texcoords[v.y] + barycentric.y * mesh.texcoords[v.z]);
  }
};

}  // namespace umbrameter
