// Triangles so large that Embree's rounding would require a visible offset of the rays that leave them. Finds them and
// intersects them in double precision, without Embree. For raytrace/*.cpp and tests.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scenes/scene.h"

namespace umbrameter {

/// Metres. With Embree's floats the offset is about 1e-6 of a triangle's longest edge: 0.05 mm here.
inline constexpr double min_huge_edge = 50.0;
/// If more triangles of a scene are so large, only larger ones count as huge: see huge_edge().
inline constexpr std::uint64_t max_huge_triangles = 4096;

struct HugeTriangle {
  std::uint32_t id = 0;  ///< in its mesh
  dvec3 corners[3]{};
  /// Bounds on Embree's error at the edges that start at each corner: relative to the sum of the distances of the
  /// edge's corners from the ray's origin, and absolute, metres. Zero for edges that only huge triangles can share.
  double relative_margin[3]{};
  double margin[3]{};
};

struct HugeHit {
  double distance = 0.0;  ///< in lengths of the direction
  dvec2 weights{0.0};     ///< of the second and third corner
};
/// Intersection with the line, in front of its origin or behind. A line through an edge that two triangles share hits
/// one of them.
std::optional<HugeHit> intersect_line(const HugeTriangle& triangle, const dvec3& origin, const dvec3& direction);

/// The longest edge of a transformed mesh, metres, among the triangles without an edge longer than `max_edge`.
double longest_edge(const Mesh& mesh, const dmat4& placed, double max_edge);

/// A mesh as the tracer stores it: in world space if it has one instance, in its own space if it has several.
struct StoredMesh {
  const Mesh* mesh = nullptr;
  dmat4 placed{1.0};
  double stretch = 1.0;  ///< largest scale factor from the space in which it is stored to the world
  double longest_edge = 0.0;
};

/// Triangles with an edge longer than this are huge, metres: min_huge_edge, doubled until there are at most
/// max_huge_triangles.
double huge_edge(const std::vector<StoredMesh>& meshes);

/// The huge triangles of a mesh, sorted by id.
std::vector<HugeTriangle> huge_triangles(const StoredMesh& stored, double huge_edge);

}  // namespace umbrameter
