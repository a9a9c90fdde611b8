#include "raytrace/surfel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "raytrace/huge_offset.h"
#include "raytrace/tracer_state.h"
#include "raytrace/vectors.h"

namespace umbrameter {
namespace {

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
dvec3 inset_from_edges(const SurfelTriangle& t, const std::array<double, 3>& insets, dvec3 point) {
  // Each push may bring the point nearer to another edge: it ends when three in a row have nothing to do. In a corner
  // of angle α two pushes leave cos² α of what was missing.
  constexpr int most_pushes = 120;
  const dvec3* const starts[] = {&t.corners.a, &t.corners.b, &t.corners.c};
  bool moved = false;
  int idle = 0;
  for (int i = 0; i < most_pushes && idle < 3; ++i) {
    const auto edge = static_cast<std::size_t>(i % 3);
    const dvec3 inwards = t.inwards(i % 3);
    const double missing = insets[edge] - glm::dot(point - *starts[edge], inwards);
    ++idle;
    if (missing <= 1e-3 * insets[edge]) continue;
    idle = 0;
    point += missing * inwards;
    moved = true;
  }
  return moved ? nearest_point(t.corners, point) : point;
}

// The triangles below are worked on four at a time: a number stands for four.

UMBRAMETER_IN_VECTORS double absolute(double v) { return std::abs(v); }
UMBRAMETER_IN_VECTORS double root(double v) { return std::sqrt(v); }
UMBRAMETER_IN_VECTORS Four absolute(const Four& v) { return v < 0.0 ? -v : v; }
UMBRAMETER_IN_VECTORS Four root(const Four& v) {
  Four result;
  for (int i = 0; i < 4; ++i) result[i] = std::sqrt(v[i]);
  return result;
}
template <class Real>
UMBRAMETER_IN_VECTORS Real least(const Real& v, const Real& w) {
  return w < v ? w : v;
}
template <class Real>
UMBRAMETER_IN_VECTORS Real greatest(const Real& v, const Real& w) {
  return v < w ? w : v;
}

// One vector, or four.
template <class Real>
struct Vector {
  Real x, y, z;
};
template <class Real>
UMBRAMETER_IN_VECTORS Vector<Real> operator-(const Vector<Real>& v, const Vector<Real>& w) {
  return {v.x - w.x, v.y - w.y, v.z - w.z};
}
template <class Real>
UMBRAMETER_IN_VECTORS Vector<Real> operator*(const Real& s, const Vector<Real>& v) {
  return {s * v.x, s * v.y, s * v.z};
}
template <class Real>
UMBRAMETER_IN_VECTORS Real dot(const Vector<Real>& v, const Vector<Real>& w) {
  return v.x * w.x + v.y * w.y + v.z * w.z;
}
template <class Real>
UMBRAMETER_IN_VECTORS Vector<Real> cross(const Vector<Real>& v, const Vector<Real>& w) {
  return {v.y * w.z - v.z * w.y, v.z * w.x - v.x * w.z, v.x * w.y - v.y * w.x};
}
template <class Real>
UMBRAMETER_IN_VECTORS Vector<Real> absolute(const Vector<Real>& v) {
  return {absolute(v.x), absolute(v.y), absolute(v.z)};
}

// By columns, the last of them the translation.
template <class Real>
struct Transform {
  Vector<Real> x, y, z, constant;
};
template <class Real>
UMBRAMETER_IN_VECTORS Transform<Real> absolute(const Transform<Real>& m) {
  return {absolute(m.x), absolute(m.y), absolute(m.z), absolute(m.constant)};
}
template <class Real>
UMBRAMETER_IN_VECTORS Vector<Real> operator*(const Transform<Real>& m, const Vector<Real>& v) {
  return {m.x.x * v.x + m.y.x * v.y + (m.z.x * v.z + m.constant.x),
          m.x.y * v.x + m.y.y * v.y + (m.z.y * v.z + m.constant.y),
          m.x.z * v.x + m.y.z * v.y + (m.z.z * v.z + m.constant.z)};
}

template <class Real>
using Corners = std::array<Vector<Real>, 3>;

template <class Real>
UMBRAMETER_IN_VECTORS Real greatest_length(const Corners<Real>& c) {
  return root(greatest(greatest(dot(c[0], c[0]), dot(c[1], c[1])), dot(c[2], c[2])));
}

// Embree tells on which side of a triangle's plane a ray starts by T = v·N, and whether it rises by N·d: v goes from
// the origin to a corner, N is the cross product of two edges that include the shortest, all in floats. No edge is
// longer than L, nor v while the origin stands over the triangle.
struct SideError {
  Four height;  // error of T / |N|, metres
  Four cosine;  // error of N·d / |N|
};

// With s the shortest edge:
//   corners seen from the origin are rounded: the plane moves by u·L under an origin that stands over the triangle, and
//   turns by 2u·L over the triangle's least height |N| / L
//   edges and their cross product are rounded: 2u·s·L and 3u·s·L of N (u and γ(n) as at half_ulp)
//   the dot product: 4u of its factors' lengths
// A quarter more is for an origin beside the triangle by an eighth of its least height. Without an area neither is a
// number.
UMBRAMETER_IN_VECTORS SideError side_error(const Four& shortest, const Four& longest, const Four& twice_area) {
  const Four by_height = longest / twice_area;
  const Four turn = 5.0 * half_ulp * shortest * by_height + 4.0 * half_ulp;
  return {1.25 * (turn * longest + half_ulp * longest), 1.25 * (turn + 2.0 * half_ulp * longest * by_height)};
}

// The errors that grow with the origin's place, on any point of the triangle: both are lengths of functions that are
// convex along any line, and so nowhere more than at one of the corners.
UMBRAMETER_IN_VECTORS Four place_error(const Corners<Four>& world, const Transform<Four>& origin_error) {
  const Corners<Four> moved{origin_error * absolute(world[0]), origin_error * absolute(world[1]),
                            origin_error * absolute(world[2])};
  return half_ulp * greatest_length(world) + greatest_length(moved);
}

// File coordinates p and the translation t are floats that were rounded once, |M|·|p| + |t| to first order; storing the
// world position as a float rounds once more.
template <class Real>
UMBRAMETER_IN_VECTORS Real vertex_error(const Transform<Real>& world_from_mesh, const Corners<Real>& in_mesh) {
  const Transform<Real> m = absolute(world_from_mesh);
  return 2.0 * half_ulp *
         greatest_length(Corners<Real>{m * absolute(in_mesh[0]), m * absolute(in_mesh[1]), m * absolute(in_mesh[2])});
}

Vector<double> of(const dvec3& v) { return {v.x, v.y, v.z}; }
Transform<double> of(const dmat4& m) { return {of(dvec3(m[0])), of(dvec3(m[1])), of(dvec3(m[2])), of(dvec3(m[3]))}; }

}  // namespace

double vertex_error(const Scene& scene, std::uint32_t instance, std::uint32_t triangle) {
  const Instance& placed = scene.instances[instance];
  const Mesh& mesh = scene.meshes[placed.mesh];
  const uvec3 corners = mesh.triangles[triangle];
  return vertex_error(of(placed.world_from_mesh),
                      Corners<double>{of(dvec3(mesh.positions[corners.x])), of(dvec3(mesh.positions[corners.y])),
                                      of(dvec3(mesh.positions[corners.z]))});
}

namespace {

// What describe() reads and writes of four triangles.
struct Asked {
  Corners<Four> in_mesh;
  Transform<Four> world_from_mesh;
  Transform<Four> origin_error;
  Four longest_edge;  // of all triangles of the mesh
  Four can_be_told;   // 1, or 0 where the mesh is scaled unlike in space of its own
};
struct Told {
  Corners<Four> corners, inwards;
  Vector<Four> normal;
  std::array<Four, 3> insets;
  Four height, offset, clear_cosine;
};

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
UMBRAMETER_VECTORS void describe_four(const Asked& asked, Told& told) {
  const Four zero{};
  const Corners<Four> corners{asked.world_from_mesh * asked.in_mesh[0], asked.world_from_mesh * asked.in_mesh[1],
                              asked.world_from_mesh * asked.in_mesh[2]};
  const Corners<Four> edges{corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
  const std::array<Four, 3> lengths{root(dot(edges[0], edges[0])), root(dot(edges[1], edges[1])),
                                    root(dot(edges[2], edges[2]))};
  const Four longest = greatest(greatest(lengths[0], lengths[1]), lengths[2]);
  const Four shortest = least(least(lengths[0], lengths[1]), lengths[2]);
  const Vector<Four> perpendicular = cross(edges[2], edges[0]);
  const Four twice_area = root(dot(perpendicular, perpendicular));

  // Where it takes more than this, in parts of an edge, the triangle is flat, and a hit on it is told by its id.
  constexpr double most_side_error = 96.0 * half_ulp;
  const SideError side = side_error(shortest, longest, twice_area);
  const Four usual = 8.0 * half_ulp * asked.longest_edge;
  const Four most = greatest(usual, most_side_error * longest);
  const auto is_told = (asked.can_be_told > zero) & (twice_area > zero) & (side.height < most);
  const Four rounding = greatest(usual, is_told ? side.height : zero);
  const Four offset =
      2.0 * vertex_error(asked.world_from_mesh, asked.in_mesh) + rounding + place_error(corners, asked.origin_error);

  told.corners = corners;
  told.offset = offset;
  // The least height of the triangle is twice its area over its longest edge.
  const auto keeps_clear = is_told & (8.0 * offset * longest < twice_area);
  told.clear_cosine = keeps_clear ? 2.0 * side.cosine : zero + 2.0;
  const auto has_area = twice_area > zero;
  const Four by_area = has_area ? 1.0 / twice_area : zero;
  told.normal = by_area * perpendicular;
  for (std::size_t i = 0; i < 3; ++i) {
    const Four by_length = has_area ? 1.0 / lengths[i] : zero;
    told.inwards[i] = by_length * cross(told.normal, edges[i]);
    const Four height = twice_area * by_length;
    if (i == 1) told.height = height;
    // Room for an origin that stands `offset` high and is off by as much, under neighbours that rise at 28 degrees or
    // more: 4 ≥ cot(28° / 2). Where the triangle is thin, a third of the way to the opposite corner.
    told.insets[i] =
        has_area ? least(4.0 * offset, height * (1.0 / 3.0)) : zero + std::numeric_limits<double>::infinity();
  }
}

void set(Vector<Four>& vectors, int lane, const dvec3& v) {
  vectors.x[lane] = v.x;
  vectors.y[lane] = v.y;
  vectors.z[lane] = v.z;
}
dvec3 get(const Vector<Four>& vectors, int lane) { return {vectors.x[lane], vectors.y[lane], vectors.z[lane]}; }

void ask(const Tracer& tracer, const SurfelTriangle& triangle, int lane, Asked& asked) {
  const Instance& placed = tracer.scene().instances[triangle.instance];
  const InstanceInfo& info = tracer.state().instances[triangle.instance];
  const Mesh& mesh = tracer.scene().meshes[placed.mesh];
  const uvec3 corners = mesh.triangles[triangle.id];
  for (int c = 0; c < 3; ++c) set(asked.in_mesh[static_cast<std::size_t>(c)], lane, dvec3(mesh.positions[corners[c]]));
  const dmat4& m = placed.world_from_mesh;
  set(asked.world_from_mesh.x, lane, dvec3(m[0]));
  set(asked.world_from_mesh.y, lane, dvec3(m[1]));
  set(asked.world_from_mesh.z, lane, dvec3(m[2]));
  set(asked.world_from_mesh.constant, lane, dvec3(m[3]));
  set(asked.origin_error.x, lane, info.origin_error.of_place[0]);
  set(asked.origin_error.y, lane, info.origin_error.of_place[1]);
  set(asked.origin_error.z, lane, info.origin_error.of_place[2]);
  set(asked.origin_error.constant, lane, info.origin_error.constant);
  asked.longest_edge[lane] = info.longest_edge;
  asked.can_be_told[lane] = !info.is_shared || info.is_similar ? 1.0 : 0.0;
}

void set(SurfelTriangle& triangle, int at, const dvec3& v) {
  triangle.x[at] = v.x;
  triangle.y[at] = v.y;
  triangle.z[at] = v.z;
}

void tell(const Told& told, int lane, SurfelTriangle& triangle) {
  triangle.corners = {get(told.corners[0], lane), get(told.corners[1], lane), get(told.corners[2], lane)};
  for (int i = 0; i < 3; ++i) {
    const auto edge = static_cast<std::size_t>(i);
    set(triangle, i, get(told.inwards[edge], lane));
    triangle.insets[edge] = told.insets[edge][lane];
    // The edge that starts at b is seen from a, which stands that high over it.
    triangle.least[i] = i == 1 ? triangle.insets[edge] - told.height[lane] : triangle.insets[edge];
  }
  set(triangle, 3, get(told.normal, lane));
  triangle.least[3] = -std::numeric_limits<double>::infinity();
  triangle.offset = told.offset[lane];
  triangle.clear_cosine = told.clear_cosine[lane];
  triangle.offset_gain = dvec3(0.0);
}

void describe_up_to_four(const Tracer& tracer, SurfelTriangle* first, std::size_t count) {
  Asked asked{};
  Told told;
  for (std::size_t lane = 0; lane < count; ++lane) ask(tracer, first[lane], static_cast<int>(lane), asked);
  describe_four(asked, told);
  for (std::size_t lane = 0; lane < count; ++lane) {
    tell(told, static_cast<int>(lane), first[lane]);
    if (tracer.state().instances[first[lane].instance].huge != nullptr) describe_huge(tracer, first[lane]);
  }
}

}  // namespace

void SurfelTable::describe() {
  for (; described_ < size_; described_ = std::min(described_ + 4, size_)) {
    describe_up_to_four(tracer_, &triangles_[described_], std::min<std::size_t>(4, size_ - described_));
  }
}

RayOrigin origin_off_foot(const SurfelTriangle& t, const dvec3& position, const dvec3& normal) {
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

RayOrigin ray_origin(const Tracer& tracer, const GBuffer& gbuffer, std::size_t pixel) {
  SurfelTriangle triangle;
  triangle.instance = gbuffer.instance[pixel];
  triangle.id = gbuffer.triangle[pixel];
  describe_up_to_four(tracer, &triangle, 1);
  return origin_on(triangle, gbuffer, pixel);
}

}  // namespace umbrameter
