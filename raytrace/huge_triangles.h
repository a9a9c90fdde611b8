// Triangles so large that rounding in Embree's test would move the rays that leave them: which they are, and a test in
// double precision. Knows nothing of Embree. For raytrace/*.cpp and tests.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scenes/scene.h"

namespace umbrameter {

/// Metres. Embree's floats take an offset of about 1e-6 of a triangle's longest edge: 0.05 mm here.
inline constexpr double least_huge_edge = 50.0;
/// Where more triangles than this are so large, they are what the scene is made of, and only larger ones are huge.
inline constexpr std::uint64_t most_huge_triangles = 4096;

struct HugeTriangle {
  std::uint32_t id = 0;  ///< in its mesh
  dvec3 corners[3]{};
  /// What Embree may be off on the edges that start at each corner, relative to the lengths of both their corners as
  /// seen from a ray's origin, and absolute, metres. Zero for edges that only huge triangles can share.
  double relative_margin[3]{};
  double margin[3]{};
};

struct HugeHit {
  double distance = 0.0;  ///< in lengths of the direction
  dvec2 weights{0.0};     ///< of the second and third corner
};
/// Where the line meets the triangle, before its origin or behind. Lines through an edge that two triangles share meet
/// one of them.
std::optional<HugeHit> meet(const HugeTriangle& triangle, const dvec3& origin, const dvec3& direction);

/// The longest edge of a mesh so placed, metres; of the triangles alone whose edges are no longer than `most`.
double longest_edge(const Mesh& mesh, const dmat4& placed, double most);

/// The meshes of a scene as a tracer stores them: those of one instance in the world, others in their own space.
struct StoredMesh {
  const Mesh* mesh = nullptr;
  dmat4 placed{1.0};
  double stretch = 1.0;  ///< metres in the world for one in the space that it is stored in, at most
  double longest_edge = 0.0;
};

/// Metres: triangles with a longer edge are huge. Never less than least_huge_edge.
double huge_edge(const std::vector<StoredMesh>& meshes);

/// The triangles that are huge, by id.
std::vector<HugeTriangle> huge_triangles(const StoredMesh& stored, double huge_edge);

}  // namespace umbrameter
