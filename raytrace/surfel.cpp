#include "raytrace/surfel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "raytrace/huge_offset.h"
#include "raytrace/tracer_state.h"
#include "raytrace/vectors.h"

namespace umbrameter {
namespace {

// The point of a triangle nearest to a position (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
dvec3 nearest_point(const Triangle& triangle, const dvec3& position) {
  const auto& [a, b, c] = triangle;
  const dvec3 ab = b - a;
  const dvec3 ac = c - a;
  const dvec3 ap = position - a;
  const double d1 = glm::dot(ab, ap);
  const double d2 = glm::dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const dvec3 bp = position - b;
  const double d3 = glm::dot(ab, bp);
  const double d4 = glm::dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + ab * (d1 / (d1 - d3));
  const dvec3 cp = position - c;
  const double d5 = glm::dot(ab, cp);
  const double d6 = glm::dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double scale = 1.0 / (va + vb + vc);
  return a + ab * (vb * scale) + ac * (vc * scale);
}

// Moves a point near an edge of its triangle inwards, until it keeps `insets` from each edge: at a crease the rounded
// origin must not fall behind the neighbour that rises there.
dvec3 inset_from_edges(const SurfelTriangle& t, const std::array<double, 3>& insets, dvec3 point) {
  // A push away from one edge may move the point towards another, so the loop ends after three edges in a row that need
  // no push. In a corner of angle α two pushes leave cos² α of the missing distance.
  constexpr int max_pushes = 120;
  const dvec3* const starts[] = {&t.corners.a, &t.corners.b, &t.corners.c};
  bool moved = false;
  int idle = 0;
  for (int i = 0; i < max_pushes && idle < 3; ++i) {
    const auto edge = static_cast<std::size_t>(i % 3);
    const dvec3 inwards = t.inwards[edge];
    const double missing = insets[edge] - glm::dot(point - *starts[edge], inwards);
    ++idle;
    if (missing <= 1e-3 * insets[edge]) continue;
    idle = 0;
    point += missing * inwards;
    moved = true;
  }
  return moved ? nearest_point(t.corners, point) : point;
}

double max_length(const dvec3& a, const dvec3& b, const dvec3& c) {
  return std::sqrt(std::max(std::max(glm::dot(a, a), glm::dot(b, b)), glm::dot(c, c)));
}

struct Affine {
  dmat3 linear;
  dvec3 constant;
  dvec3 operator()(const dvec3& v) const { return (linear[0] * v.x + linear[1] * v.y) + (linear[2] * v.z + constant); }
};
Affine affine(const dmat4& m) { return {dmat3(m), dvec3(m[3])}; }
Affine absolute(const Affine& m) {
  return {{glm::abs(m.linear[0]), glm::abs(m.linear[1]), glm::abs(m.linear[2])}, glm::abs(m.constant)};
}

// Embree finds on which side of a triangle's plane a ray starts from the sign of T = v·N, and whether the ray rises
// from it from N·d: v goes from the ray's origin to a corner, N is the cross product of two edges, one of them the
// shortest, and all are floats. No edge is longer than L, nor is v while the origin is above the triangle.
struct SideError {
  double height;  // error of T / |N|, metres
  double cosine;  // error of N·d / |N|
};

// With s the shortest edge:
//   The corners relative to the origin are rounded. The plane moves by u·L below an origin above the triangle, and
//   turns by 2u·L over the triangle's least height |N| / L.
//   The edges and their cross product are rounded: 2u·s·L and 3u·s·L of N (u and γ(n) as at half_ulp).
//   The dot product: 4u of its factors' lengths.
// A quarter is added for an origin beside the triangle by up to an eighth of its least height. Without area neither
// error is a number.
SideError side_error(double shortest, double longest, double twice_area) {
  const double by_height = longest / twice_area;
  const double turn = 5.0 * half_ulp * shortest * by_height + 4.0 * half_ulp;
  return {1.25 * (turn * longest + half_ulp * longest), 1.25 * (turn + 2.0 * half_ulp * longest * by_height)};
}

// Bound on the errors that grow with the origin's coordinates, for any point of the triangle: both are lengths of
// functions that are convex along any line, so the largest values are at corners.
double origin_rounding(const Triangle& t, const InstanceInfo& info) {
  const double rounding = half_ulp * max_length(t.a, t.b, t.c);
  if (!info.is_shared) return rounding;
  const Affine error{info.origin_error.linear, info.origin_error.constant};
  return rounding + max_length(error(glm::abs(t.a)), error(glm::abs(t.b)), error(glm::abs(t.c)));
}

// The file's coordinates p and the translation t are floats that were rounded once, |M|·|p| + |t| to first order;
// storing the world position as a float rounds once more.
double vertex_error(const dmat4& world_from_mesh, const std::array<dvec3, 3>& in_mesh) {
  const Affine m = absolute(affine(world_from_mesh));
  return 2.0 * half_ulp * max_length(m(glm::abs(in_mesh[0])), m(glm::abs(in_mesh[1])), m(glm::abs(in_mesh[2])));
}

std::array<dvec3, 3> corners_in_mesh(const Scene& scene, std::uint32_t instance, std::uint32_t triangle) {
  const Mesh& mesh = scene.meshes[scene.instances[instance].mesh];
  const uvec3 corners = mesh.triangles[triangle];
  return {dvec3(mesh.positions[corners.x]), dvec3(mesh.positions[corners.y]), dvec3(mesh.positions[corners.z])};
}

}  // namespace

double vertex_error(const Scene& scene, std::uint32_t instance, std::uint32_t triangle) {
  return vertex_error(scene.instances[instance].world_from_mesh, corners_in_mesh(scene, instance, triangle));
}

// The step along the normal is for other triangles in the same plane, which must not be hit although they, the ray and
// the test are rounded. These errors add up along the normal:
//   vertices of the neighbour and of the own triangle            2 · vertex_error
//   the origin p, rounded to floats                              u · |p|
//   the origin, transformed to a shared mesh's space             InstanceInfo::origin_error
//   Embree's distance to the neighbour's plane, (v − o)·N / |N|: differences, a dot product of three terms and the
//   normal's own rounding, at most eight roundings of lengths up to an edge       8u · longest edge
//   or, where that is more and the triangle no sliver, its own side_error
// (Waechter and Binder, A Fast and Robust Method for Avoiding Self-Intersection, Ray Tracing Gems, 2019, chapter 6,
// measure the same sources; Pharr, Jakob and Humphreys, Physically Based Rendering, 4th ed., 6.8, bound them this way.)
UMBRAMETER_VECTORS SurfelTriangle describe_triangle(const Tracer& tracer, std::uint32_t instance, std::uint32_t id) {
  const InstanceInfo& info = tracer.state().instances[instance];
  SurfelTriangle t;  // every member is set below: zeroing it first costs a tenth of the function
  const dmat4& world_from_mesh = tracer.scene().instances[instance].world_from_mesh;
  const std::array<dvec3, 3> in_mesh = corners_in_mesh(tracer.scene(), instance, id);
  const Affine to_world = affine(world_from_mesh);
  t.corners = {to_world(in_mesh[0]), to_world(in_mesh[1]), to_world(in_mesh[2])};
  const auto& [a, b, c] = t.corners;
  const dvec3 edges[] = {b - a, c - b, a - c};
  const double lengths[] = {glm::length(edges[0]), glm::length(edges[1]), glm::length(edges[2])};
  const double longest = std::max(std::max(lengths[0], lengths[1]), lengths[2]);
  const double shortest = std::min(std::min(lengths[0], lengths[1]), lengths[2]);
  const dvec3 perpendicular = glm::cross(edges[2], edges[0]);
  const double twice_area = glm::length(perpendicular);

  // Above this share of its longest edge the triangle is a sliver: hits on it are excluded by its id alone.
  constexpr double max_side_error = 96.0 * half_ulp;
  const SideError side = side_error(shortest, longest, twice_area);
  const double neighbour = 8.0 * half_ulp * info.longest_edge;
  // Of a shared mesh Embree tests rays in mesh space, where the bound holds only if the scale is uniform.
  const bool is_bounded = (!info.is_shared || info.is_similar) && twice_area > 0.0 &&
                          side.height < std::max(neighbour, max_side_error * longest);
  const double rounding = std::max(neighbour, is_bounded ? side.height : 0.0);
  t.offset = 2.0 * vertex_error(world_from_mesh, in_mesh) + rounding + origin_rounding(t.corners, info);
  // The least height of the triangle is twice its area over its longest edge.
  t.clear_cosine = is_bounded && 8.0 * t.offset * longest < twice_area ? 2.0 * side.cosine : 2.0;
  if (!(twice_area > 0.0)) {
    t.normal = dvec3(0.0);
    t.inwards.fill(dvec3(0.0));
    t.insets.fill(std::numeric_limits<double>::infinity());
    t.min_inwards = t.insets;
  } else {
    t.normal = (1.0 / twice_area) * perpendicular;
    for (std::size_t i = 0; i < 3; ++i) {
      const double by_length = 1.0 / lengths[i];
      t.inwards[i] = by_length * glm::cross(t.normal, edges[i]);
      const double height = twice_area * by_length;
      // Room for an origin that is `offset` high and off by as much, below neighbours that rise at 28 degrees or more:
      // 4 ≥ cot(28° / 2). Where the triangle is thin, a third of the way to the opposite corner.
      t.insets[i] = std::min(4.0 * t.offset, height * (1.0 / 3.0));
      // The edge that starts at b is opposite to a, which is `height` above it.
      t.min_inwards[i] = i == 1 ? t.insets[i] - height : t.insets[i];
    }
  }
  t.offset_gain = dvec3(0.0);
  if (info.huge != nullptr) describe_huge(tracer, instance, id, t);
  return t;
}

RayOrigin origin_near_edge(const SurfelTriangle& t, const dvec3& position, const dvec3& normal) {
  RayOrigin origin{dvec3(0.0), normal, t.offset, t.clear_cosine};
  dvec3 point = nearest_point(t.corners, position);
  std::array<double, 3> insets = t.insets;
  if (t.is_huge()) {
    origin.offset = offset_at(t, point);
    for (double& inset : insets) inset = std::min(inset, 4.0 * origin.offset);
  }
  if (t.has_area()) point = inset_from_edges(t, insets, point);
  origin.point = point + origin.offset * normal;
  return origin;
}

}  // namespace umbrameter
