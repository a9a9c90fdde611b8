#include "raytrace/huge_offset.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "raytrace/tracer_state.h"

namespace umbrameter {
namespace {

dmat3 absolute(const dmat3& m) { return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])}; }

// Rounds the mantissa up to four bits, so that more pixels have equal offsets and share packets.
double rounded_up(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::ceil(16.0 * mantissa) / 16.0, exponent);
}

}  // namespace

// As in surfel.cpp, the step is for other triangles in the same plane, which must not be hit. The huge triangle itself
// is intersected in double precision. All errors are measured along the normal n, where a level ground has almost none,
// and those of the origin at the point itself. With u and γ as at half_ulp:
//   file coordinates and the translation of two such triangles, each rounded once
//                                                           2u · (max |n·M|·|p| over the corners + |n|·|t|)
//   the origin at p, rounded to floats                      u · |n|·|p|
//   the vertices of a neighbour that is not huge, no farther from p than its longest edge ℓ: file and float
//                                                           2u · |n|·(|p| + ℓ·√(1 − n²))
//   Embree's distance to that neighbour's plane: side_error of a triangle that is no sliver        16u · ℓ
//   of a shared mesh, the origin transformed to its space   InstanceInfo::origin_error
//   and its matrix rounded to floats, for two such          2u · |n|·(|M|·|M⁻¹|·(|p| + |t|) + |t|)
//   in double precision: corners, normal and the projection of p, at most 64 roundings of the longest edge over the
//   least height
void describe_huge(const Tracer& tracer, std::uint32_t instance, std::uint32_t id, SurfelTriangle& triangle) {
  const Tracer::State& state = tracer.state();
  const InstanceInfo& info = state.instances[instance];
  if (!triangle.has_area() || !info.huge->has(id)) return;
  const Instance& placed = tracer.scene().instances[instance];
  const Mesh& mesh = tracer.scene().meshes[placed.mesh];
  const dmat3 linear(placed.world_from_mesh);
  const dvec3 translation = glm::abs(dvec3(placed.world_from_mesh[3]));
  const dvec3 normal = glm::abs(triangle.normal);

  const dvec3 across = glm::abs(glm::transpose(linear) * triangle.normal);
  const uvec3 vertices = mesh.triangles[id];
  double of_file = 0.0;
  for (int c = 0; c < 3; ++c)
    of_file = std::max(of_file, glm::dot(across, glm::abs(dvec3(mesh.positions[vertices[c]]))));
  double constant = 2.0 * half_ulp * (of_file + glm::dot(normal, translation));
  dvec3 gain = 3.0 * half_ulp * normal;
  const dvec3 in_plane = glm::sqrt(glm::max(1.0 - normal * normal, dvec3(0.0)));
  constant += half_ulp * state.longest_edge * (16.0 + 2.0 * glm::dot(normal, in_plane));
  if (info.is_shared) {
    const dvec3 moved = 2.0 * half_ulp * (glm::transpose(absolute(linear) * absolute(glm::inverse(linear))) * normal);
    gain += moved + glm::transpose(info.origin_error.linear) * normal;
    constant += glm::dot(moved, translation) + 2.0 * half_ulp * glm::dot(normal, translation) +
                glm::dot(normal, info.origin_error.constant);
  }

  const auto& [a, b, c] = triangle.corners;
  const double lengths[] = {glm::length(b - a), glm::length(c - b), glm::length(a - c)};
  const double longest = std::max({lengths[0], lengths[1], lengths[2]});
  const double twice_area = glm::length(glm::cross(b - a, c - a));
  const double farthest = std::max({glm::length(a), glm::length(b), glm::length(c)});
  constant += 64.0 * 0x1p-53 * (longest * longest * longest / twice_area + farthest);

  triangle.offset = constant;
  triangle.offset_gain = gain;
  // No ray hits its own huge triangle, because for_each_hit() in huge_geometry.cpp ignores it without a filter.
  triangle.clear_cosine = -1.0;
  for (std::size_t i = 0; i < 3; ++i) triangle.insets[i] = twice_area / lengths[i] / 3.0;
  triangle.min_inwards.fill(std::numeric_limits<double>::infinity());
}

// The origin is a few offsets away from the point, which adds less than a millionth.
double offset_at(const SurfelTriangle& huge, const dvec3& point) {
  return rounded_up((huge.offset + glm::dot(huge.offset_gain, glm::abs(point))) * (1.0 + 1e-6));
}

}  // namespace umbrameter
