#include "raytrace/surfel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "raytrace/tracer_state.h"

namespace umbrameter {
namespace {

dvec3 absolute(const dvec3& v) { return glm::abs(v); }
dmat3 absolute(const dmat3& m) { return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])}; }

// The point of a triangle that is nearest to a position (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
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

// Moves a point that stands on an edge of its triangle inwards, until it keeps `insets` off each edge: at a crease the
// rounded origin must not fall behind the neighbour that rises there.
dvec3 inset_from_edges(const SurfelTriangle& t, dvec3 point) {
  // Each push may bring the point nearer to another edge: it ends when three in a row have nothing to do. In a corner
  // of angle α two pushes leave cos² α of what was missing.
  constexpr int most_pushes = 120;
  const dvec3* const starts[] = {&t.corners.a, &t.corners.b, &t.corners.c};
  bool moved = false;
  int idle = 0;
  for (int i = 0; i < most_pushes && idle < 3; ++i) {
    const auto edge = static_cast<std::size_t>(i % 3);
    const double missing = t.insets[edge] - glm::dot(point - *starts[edge], t.inwards[edge]);
    ++idle;
    if (missing <= 1e-3 * t.insets[edge]) continue;
    idle = 0;
    point += missing * t.inwards[edge];
    moved = true;
  }
  return moved ? nearest_point(t.corners, point) : point;
}

// Embree tells on which side of a triangle's plane a ray starts by T = v·N, and whether it rises by N·d: v goes from
// the origin to a corner, N is the cross product of two edges that include the shortest, all in floats. No edge is
// longer than L, nor v while the origin stands over the triangle.
struct SideError {
  double longest = 0;                                       ///< L, metres
  double height = std::numeric_limits<double>::infinity();  ///< error of T / |N|, metres
  double cosine = std::numeric_limits<double>::infinity();  ///< error of N·d / |N|
  double thickness = 0;                                     ///< the least height of the triangle, metres
};

// With s the shortest edge:
//   corners seen from the origin are rounded: the plane moves by u·L under an origin that stands over the triangle, and
//   turns by 2u·L over the triangle's least height |N| / L
//   edges and their cross product are rounded: 2u·s·L and 3u·s·L of N (u and γ(n) as at half_ulp)
//   the dot product: 4u of its factors' lengths
// A quarter more is for an origin beside the triangle by an eighth of its least height.
SideError side_error(const std::array<double, 3>& edges, double twice_area) {
  const double s = std::min({edges[0], edges[1], edges[2]});
  SideError error;
  error.longest = std::max({edges[0], edges[1], edges[2]});
  if (!(twice_area > 0.0)) return error;
  const double l = error.longest;
  const double turn = 5.0 * half_ulp * s * l / twice_area + 4.0 * half_ulp;
  error.height = 1.25 * (turn * l + half_ulp * l);
  error.cosine = 1.25 * (turn + 2.0 * half_ulp * l * l / twice_area);
  error.thickness = twice_area / l;
  return error;
}

// The errors that grow with the origin's place, on any point of the triangle: both are lengths of functions that are
// convex along any line, and so nowhere more than at one of the corners.
double place_error(const Triangle& t, const InstanceInfo& info) {
  double rounded = 0.0;
  double moved = 0.0;
  for (const dvec3& corner : {t.a, t.b, t.c}) {
    rounded = std::max(rounded, glm::dot(corner, corner));
    if (!info.is_shared) continue;
    const dvec3 error = info.origin_error.of_place * absolute(corner) + info.origin_error.constant;
    moved = std::max(moved, glm::dot(error, error));
  }
  return half_ulp * std::sqrt(rounded) + std::sqrt(moved);
}

}  // namespace

// File coordinates p and the translation t are floats that were rounded once, |M|·|p| + |t| to first order; storing the
// world position as a float rounds once more.
double vertex_error(const Scene& scene, std::uint32_t instance, std::uint32_t triangle) {
  const Instance& placed = scene.instances[instance];
  const Mesh& mesh = scene.meshes[placed.mesh];
  const dmat3 linear = absolute(dmat3(placed.world_from_mesh));
  const dvec3 translation = absolute(dvec3(placed.world_from_mesh[3]));
  double squared = 0.0;
  for (int c = 0; c < 3; ++c) {
    const dvec3 error = linear * absolute(dvec3(mesh.positions[mesh.triangles[triangle][c]])) + translation;
    squared = std::max(squared, glm::dot(error, error));
  }
  return 2.0 * half_ulp * std::sqrt(squared);
}

namespace {

// The step along the normal is for triangles in the same plane, which must not be hit although they, the ray and the
// test are rounded. Along the normal these errors add up:
//   vertices of the neighbour and of the own triangle            2 · vertex_error
//   the origin p, rounded to floats                              u · |p|
//   the origin, taken into a shared mesh's space                 InstanceInfo::origin_error
//   Embree's distance to the neighbour's plane, (v − o)·N / |N|: differences, a dot product of three terms and the
//   normal's own rounding, at most eight roundings of lengths up to an edge       8u · longest edge
//   or, where it is more and the triangle no sliver, its own side_error
// (Waechter and Binder, A Fast and Robust Method for Avoiding Self-Intersection, Ray Tracing Gems, 2019, chapter 6,
// measure the same sources; Pharr, Jakob and Humphreys, Physically Based Rendering, 4th ed., 6.8, bound them this way.)
SurfelTriangle surfel_triangle(const Tracer& tracer, std::uint32_t instance, std::uint32_t id) {
  const Scene& scene = tracer.scene();
  const InstanceInfo& info = tracer.state().instances[instance];
  SurfelTriangle known;
  known.instance = instance;
  known.id = id;
  known.corners = world_triangle(scene, instance, id);
  const Triangle& t = known.corners;
  const dvec3 normal = glm::cross(t.b - t.a, t.c - t.a);
  known.twice_area = glm::length(normal);
  const dvec3 edges[] = {t.b - t.a, t.c - t.b, t.a - t.c};
  const std::array<double, 3> lengths{glm::length(edges[0]), glm::length(edges[1]), glm::length(edges[2])};
  if (known.twice_area > 0.0) {
    known.normal = normal * (1.0 / known.twice_area);
    for (std::size_t i = 0; i < 3; ++i) {
      known.inwards[i] = glm::cross(known.normal, edges[i]) * (1.0 / lengths[i]);
      known.heights[i] = known.twice_area / lengths[i];
    }
  }
  // Where it takes more than this, in parts of an edge, the triangle is flat, and a hit on it is told by its id.
  constexpr double most_side_error = 96.0 * half_ulp;
  const SideError side = side_error(lengths, known.twice_area);
  const bool is_told = side.height < std::max(8.0 * half_ulp * info.longest_edge, most_side_error * side.longest) &&
                       (!info.is_shared || info.is_similar);
  const double rounding = std::max(8.0 * half_ulp * info.longest_edge, is_told ? side.height : 0.0);
  known.offset = 2.0 * vertex_error(scene, instance, id) + rounding + place_error(t, info);
  if (is_told && known.offset < side.thickness / 8.0) known.clear_cosine = 2.0 * side.cosine;
  // Room for an origin that stands `offset` high and is off by as much, under neighbours that rise at 28 degrees or
  // more: 4 ≥ cot(28° / 2). Where the triangle is thin, a third of the way to the opposite corner.
  for (std::size_t i = 0; i < 3; ++i) known.insets[i] = std::min(4.0 * known.offset, known.heights[i] / 3.0);
  return known;
}

}  // namespace

void SurfelCache::fill(SurfelTriangle& slot, const Tracer& tracer, std::uint32_t instance, std::uint32_t id) {
  slot = surfel_triangle(tracer, instance, id);
}

dvec3 surface_point(const SurfelTriangle& t, const dvec3& position) {
  const dvec3 nearest = nearest_point(t.corners, position);
  return t.twice_area > 0.0 ? inset_from_edges(t, nearest) : nearest;
}

RayOrigin ray_origin(const Tracer& tracer, const GBuffer& gbuffer, std::size_t pixel) {
  return origin_on(surfel_triangle(tracer, gbuffer.instance[pixel], gbuffer.triangle[pixel]), gbuffer, pixel);
}

}  // namespace umbrameter
