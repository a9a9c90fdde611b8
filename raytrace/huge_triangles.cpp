#include "raytrace/huge_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "raytrace/instance_error.h"

namespace umbrameter {
namespace {

// Six times the volume of the tetrahedron spanned by an edge and the direction. Its sign is the side on which the line
// passes the edge. For the reversed edge the result is negated exactly.
double side_of(const dvec3& from, const dvec3& to, const dvec3& direction) {
  return glm::dot(glm::cross(from, to), direction);
}

}  // namespace

std::optional<HugeHit> intersect_line(const HugeTriangle& triangle, const dvec3& origin, const dvec3& direction) {
  const dvec3 seen[] = {triangle.corners[0] - origin, triangle.corners[1] - origin, triangle.corners[2] - origin};
  const double sides[] = {side_of(seen[0], seen[1], direction), side_of(seen[1], seen[2], direction),
                          side_of(seen[2], seen[0], direction)};
  const bool is_within = (sides[0] >= 0.0 && sides[1] >= 0.0 && sides[2] >= 0.0) ||
                         (sides[0] <= 0.0 && sides[1] <= 0.0 && sides[2] <= 0.0);
  const double sum = sides[0] + sides[1] + sides[2];
  if (!is_within) {
    for (int i = 0; i < 3; ++i) {
      const double inside = sum < 0.0 ? -sides[i] : sides[i];
      if (inside >= 0.0) continue;
      const dvec3& to = seen[(i + 1) % 3];
      const double margin = triangle.relative_margin[i] * (glm::length(seen[i]) + glm::length(to)) + triangle.margin[i];
      if (!(margin > 0.0)) return std::nullopt;
      if (-inside > margin * glm::length(to - seen[i]) * glm::length(direction)) return std::nullopt;
    }
  }
  const dvec3 normal = glm::cross(seen[1] - seen[0], seen[2] - seen[0]);
  const double along = glm::dot(normal, direction);
  if (along == 0.0 || sum == 0.0) return std::nullopt;
  const dvec2 weights = glm::clamp(dvec2(sides[2], sides[0]) / sum, 0.0, 1.0);
  return HugeHit{glm::dot(normal, seen[0]) / along, weights};
}

double longest_edge(const Mesh& mesh, const dmat4& placed, double max_edge) {
  double longest = 0.0;
  for (const uvec3& triangle : mesh.triangles) {
    const double edge = longest_edge(world_corners(mesh, triangle, placed));
    if (edge <= max_edge) longest = std::max(longest, edge);
  }
  return longest;
}

double huge_edge(const std::vector<StoredMesh>& meshes) {
  // Numbers of triangles by ⌊log2(edge / min_huge_edge)⌋.
  std::array<std::uint64_t, 1024> counts{};
  for (const StoredMesh& stored : meshes) {
    if (stored.longest_edge * stored.stretch <= min_huge_edge) continue;
    for (const uvec3& triangle : stored.mesh->triangles) {
      const double edge = longest_edge(world_corners(*stored.mesh, triangle, stored.placed)) * stored.stretch;
      if (!(edge > min_huge_edge) || !std::isfinite(edge)) continue;
      const int power = std::ilogb(edge / min_huge_edge);
      ++counts[static_cast<std::size_t>(std::clamp(power, 0, static_cast<int>(counts.size()) - 1))];
    }
  }
  std::size_t first = counts.size();
  for (std::uint64_t larger = 0; first > 0; --first) {
    larger += counts[first - 1];
    if (larger > max_huge_triangles) break;
  }
  return std::ldexp(min_huge_edge, static_cast<int>(first));
}

// Embree finds the side on which a ray passes an edge from the corners relative to the ray's origin, their difference
// and their sum, all in floats: the error across the ray is at most γ(8) of the corners' lengths. Transforming an edge
// to the world rounds it once more.
std::vector<HugeTriangle> huge_triangles(const StoredMesh& stored, double huge_edge) {
  std::vector<HugeTriangle> found;
  if (stored.longest_edge * stored.stretch <= huge_edge) return found;
  const double longest = huge_edge / stored.stretch;
  for (std::size_t t = 0; t < stored.mesh->triangles.size(); ++t) {
    const auto corners = world_corners(*stored.mesh, stored.mesh->triangles[t], stored.placed);
    if (!(longest_edge(corners) > longest)) continue;
    HugeTriangle huge;
    huge.id = static_cast<std::uint32_t>(t);
    for (std::size_t i = 0; i < 3; ++i) {
      const dvec3& from = corners[i];
      const dvec3& to = corners[(i + 1) % 3];
      huge.corners[i] = from;
      if (glm::length(to - from) > longest) continue;  // so long that the neighbour is huge too
      huge.relative_margin[i] = 8.0 * half_ulp;
      huge.margin[i] = half_ulp * std::max(glm::length(from), glm::length(to));
    }
    found.push_back(huge);
  }
  return found;
}

}  // namespace umbrameter
