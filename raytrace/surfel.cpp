#include "raytrace/surfel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "raytrace/tracer_state.h"

namespace umbrameter {
namespace {

// Half a unit in the last place of a float: the relative error of one rounding (Higham, Accuracy and Stability of
// Numerical Algorithms, 2002, theorem 2.2).
constexpr double u = 0x1p-24;

dvec3 absolute(const dvec3& v) { return glm::abs(v); }
dmat3 absolute(const dmat3& m) { return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])}; }

// Largest distance by which a vertex of the triangle may stand off its ideal place: file coordinates p and the
// translation t are floats that were rounded once, |M|·|p| + |t| to first order; storing the world position as a
// float rounds once more.
double vertex_error(const Scene& scene, std::uint32_t instance, std::uint32_t triangle) {
  const Instance& placed = scene.instances[instance];
  const Mesh& mesh = scene.meshes[placed.mesh];
  const dmat3 linear = absolute(dmat3(placed.world_from_mesh));
  const dvec3 translation = absolute(dvec3(placed.world_from_mesh[3]));
  double error = 0.0;
  for (int c = 0; c < 3; ++c) {
    const dvec3 p = absolute(dvec3(mesh.positions[mesh.triangles[triangle][c]]));
    error = std::max(error, glm::length(linear * p + translation));
  }
  return 2.0 * u * error;
}

// Embree takes a ray into the space of a shared mesh with a float matrix that it inverts itself. Cofactors are two
// products and a difference, the determinant three products of them, then a division: with B the cofactors' terms by
// magnitude over |det|, and D the determinant's over |det|, an entry of the inverse is off by at most γ(10)·D·B. The
// point's transform and the translation's add four roundings, so that 14 in all, seen from the world through |M|,
// bound the origin; the rounded matrix itself moves the mesh by u·(|M|·|x| + |t|), which vertex_error counts.
double transform_error(const Instance& placed, const dvec3& position) {
  const dmat3 linear = absolute(dmat3(placed.world_from_mesh));
  dmat3 cofactors(0.0);
  for (int column = 0; column < 3; ++column) {
    const dvec3& v = linear[(column + 1) % 3];
    const dvec3& w = linear[(column + 2) % 3];
    cofactors[column] = {v.y * w.z + v.z * w.y, v.z * w.x + v.x * w.z, v.x * w.y + v.y * w.x};
  }
  const double determinant = std::abs(glm::determinant(dmat3(placed.world_from_mesh)));
  if (!(determinant > 0.0)) return 0.0;  // flat: no ray meets it
  const double spread = glm::dot(linear[0], cofactors[0]) / determinant;
  const dvec3 way = absolute(position) + absolute(dvec3(placed.world_from_mesh[3]));
  const dvec3 local = glm::transpose(cofactors) * way / determinant;
  return 14.0 * u * spread * glm::length(linear * local);
}

// Moves a point that stands on an edge of its triangle inwards, until it is `inset` away from each edge, or a third of
// the way to the opposite corner where the triangle is thin: at a crease the rounded origin must not fall behind the
// neighbour that rises there.
dvec3 inset_from_edges(const SurfelTriangle& t, dvec3 point, double inset) {
  // Each push may bring the point nearer to another edge: it ends when three in a row have nothing to do. In a corner
  // of angle α two pushes leave cos² α of what was missing.
  constexpr int most_pushes = 120;
  const dvec3* const starts[] = {&t.corners.a, &t.corners.b, &t.corners.c};
  bool moved = false;
  int idle = 0;
  for (int i = 0; i < most_pushes && idle < 3; ++i) {
    const auto edge = static_cast<std::size_t>(i % 3);
    const double missing = std::min(inset, t.heights[edge] / 3.0) - glm::dot(point - *starts[edge], t.inwards[edge]);
    ++idle;
    if (missing <= 1e-3 * inset) continue;
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
//   edges and their cross product are rounded: 2u·s·L and 3u·s·L of N (γ(n) as in Higham, as above)
//   the dot product: 4u of its factors' lengths
// A quarter more is for an origin beside the triangle by an eighth of its least height.
SideError side_error(const Triangle& t, double twice_area) {
  const double edges[] = {glm::length(t.b - t.a), glm::length(t.c - t.b), glm::length(t.a - t.c)};
  const double s = std::min({edges[0], edges[1], edges[2]});
  SideError error;
  error.longest = std::max({edges[0], edges[1], edges[2]});
  if (!(twice_area > 0.0)) return error;
  const double l = error.longest;
  const double turn = 5.0 * u * s * l / twice_area + 4.0 * u;
  error.height = 1.25 * (turn * l + u * l);
  error.cosine = 1.25 * (turn + 2.0 * u * l * l / twice_area);
  error.thickness = twice_area / l;
  return error;
}

// Lengths of one direction in a mesh are lengths of every direction in the world times one factor.
bool is_similarity(const dmat4& world_from_mesh) {
  const dmat3 gram = glm::transpose(dmat3(world_from_mesh)) * dmat3(world_from_mesh);
  const double scale = (gram[0][0] + gram[1][1] + gram[2][2]) / 3.0;
  double skew = 0.0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      skew = std::max(skew, std::abs(gram[column][row] - (row == column ? scale : 0.0)));
    }
  }
  return skew <= 1e-5 * scale;
}

}  // namespace

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

// The step along the normal is for triangles in the same plane, which must not be hit although they, the ray and the
// test are rounded. Along the normal these errors add up:
//   vertices of the neighbour and of the own triangle            2 · vertex_error
//   the origin, rounded to floats                                u · |p|
//   the origin, taken into a shared mesh's space                 transform_error
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
  if (known.twice_area > 0.0) {
    known.normal = normal / known.twice_area;
    const dvec3 corners[] = {t.a, t.b, t.c};
    for (std::size_t i = 0; i < 3; ++i) {
      const dvec3 edge = corners[(i + 1) % 3] - corners[i];
      known.inwards[i] = glm::cross(known.normal, edge) / glm::length(edge);
      known.heights[i] = glm::dot(corners[(i + 2) % 3] - corners[i], known.inwards[i]);
    }
  }
  // Where it takes more than this, in parts of an edge, the triangle is flat, and a hit on it is told by its id.
  constexpr double most_side_error = 96.0 * u;
  const SideError side = side_error(t, known.twice_area);
  const bool is_told = side.height < std::max(8.0 * u * info.longest_edge, most_side_error * side.longest) &&
                       (!info.is_shared || is_similarity(scene.instances[instance].world_from_mesh));
  const double rounding = std::max(8.0 * u * info.longest_edge, is_told ? side.height : 0.0);
  known.offset = 2.0 * vertex_error(scene, instance, id) + rounding;
  if (is_told) {
    known.clear_offset = side.thickness / 8.0;
    known.clear_cosine = 2.0 * side.cosine;
  }
  return known;
}

RayOrigin ray_origin(const Tracer& tracer, const GBuffer& gbuffer, std::size_t pixel, SurfelTriangle& last) {
  const std::uint32_t instance = gbuffer.instance[pixel];
  const std::uint32_t id = gbuffer.triangle[pixel];
  if (last.instance != instance || last.id != id) last = surfel_triangle(tracer, instance, id);
  const bool has_area = last.twice_area > 0.0;
  const dvec3 seen(gbuffer.geometric_normal[pixel]);
  const dvec3 unit = has_area ? last.normal : seen;
  const dvec3 nearest = nearest_point(last.corners, dvec3(gbuffer.position[pixel]));
  RayOrigin origin;
  origin.normal = glm::dot(unit, seen) < 0.0 ? -unit : unit;
  origin.offset = last.offset + u * glm::length(nearest);
  if (tracer.state().instances[instance].is_shared) {
    origin.offset += transform_error(tracer.scene().instances[instance], nearest);
  }
  if (origin.offset < last.clear_offset) origin.clear_cosine = last.clear_cosine;
  // Room for an origin that stands `offset` high and is off by as much, under neighbours that rise at 28 degrees or
  // more: 4 ≥ cot(28° / 2).
  origin.surface = has_area ? inset_from_edges(last, nearest, 4.0 * origin.offset) : nearest;
  return origin;
}

RayOrigin ray_origin(const Tracer& tracer, const GBuffer& gbuffer, std::size_t pixel) {
  SurfelTriangle none;
  return ray_origin(tracer, gbuffer, pixel, none);
}

}  // namespace umbrameter
