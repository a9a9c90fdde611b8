// From a G-buffer pixel to the point that its rays start from. For raytrace/*.cpp and tests.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "core/gbuffer.h"
#include "raytrace/tracer.h"

namespace umbrameter {

/// Where a pixel's rays start: at a point of the exact surface, plus a step off it.
struct RayOrigin {
  /// World: the surfel's projection onto its own triangle, a few offsets in from the edges, plus offset · normal.
  dvec3 point;
  dvec3 normal;       ///< unit, of the triangle, on the side of the surfel's geometric normal
  double offset = 0;  ///< metres along the normal
  /// A ray whose cosine with the normal exceeds this cannot hit its own triangle, however Embree rounds. 2 if no such
  /// bound is known.
  double clear_cosine = 2;
};

/// Whether a ray of that direction cannot hit its own triangle, by normal and clear_cosine of its RayOrigin.
inline bool is_clear(const dvec3& normal, double clear_cosine, const vec3& direction) {
  return glm::dot(normal, dvec3(direction)) > clear_cosine;
}

/// Bound on the distance between a vertex of the triangle and its exact position, metres, world.
double vertex_error(const Scene& scene, std::uint32_t instance, std::uint32_t triangle);

/// The part of a ray origin that all pixels of a triangle share.
struct SurfelTriangle {
  Triangle corners;
  dvec3 normal;                  ///< unit; zero if the triangle has no area
  std::array<dvec3, 3> inwards;  ///< unit, in the plane, perpendicular to the edges from a, b and c; or zero
  std::array<double, 3> insets;  ///< metres: the distance of origins from those edges; infinite without area
  /// Metres from corner a along each of `inwards` from which on a position keeps the insets. Infinite if no position
  /// may skip origin_near_edge(): without area, and for a huge triangle.
  std::array<double, 3> min_inwards;
  double offset;        ///< metres: RayOrigin::offset; of a huge triangle, at the world's origin
  double clear_cosine;  ///< RayOrigin::clear_cosine
  /// Of a huge triangle: the growth of RayOrigin::offset with the absolute coordinates of the point. Else zero.
  dvec3 offset_gain;
  bool has_area() const { return normal != dvec3(0.0); }
  bool is_huge() const { return offset_gain != dvec3(0.0); }
};

/// Of the triangle with these ids in the scene.
SurfelTriangle describe_triangle(const Tracer& tracer, std::uint32_t instance, std::uint32_t id);

/// Descriptions of the triangles seen by the pixels of a tile; a new one replaces the one with the same hash.
class TriangleCache {
 public:
  static constexpr std::size_t capacity = 512;

  explicit TriangleCache(const Tracer& tracer) : tracer_(tracer) { ids_.fill(uvec2(no_id)); }

  const SurfelTriangle& get(std::uint32_t instance, std::uint32_t id) {
    const std::size_t i = (id + 29u * instance) % capacity;
    if (ids_[i] != uvec2(instance, id)) {
      ids_[i] = {instance, id};
      triangles_[i] = describe_triangle(tracer_, instance, id);
    }
    return triangles_[i];
  }

 private:
  const Tracer& tracer_;
  std::array<uvec2, capacity> ids_;  // instance and triangle; no_id if unused
  std::array<SurfelTriangle, capacity> triangles_;
};

/// For a position near an edge, or on a huge triangle: the origin above the nearest point that keeps the insets.
RayOrigin origin_near_edge(const SurfelTriangle& t, const dvec3& position, const dvec3& normal);

/// The origin of a pixel's rays. Its offset is large enough that rounding cannot put a ray behind the surface that it
/// leaves. Inline, because hard shadows need it for every ray.
inline RayOrigin ray_origin(const GBuffer& gbuffer, std::size_t pixel, TriangleCache& triangles) {
  const SurfelTriangle& t = triangles.get(gbuffer.instance[pixel], gbuffer.triangle[pixel]);
  const dvec3 position(gbuffer.position[pixel]);
  const dvec3 surfel_normal(gbuffer.geometric_normal[pixel]);
  const double side = std::copysign(1.0, glm::dot(t.normal, surfel_normal));
  const dvec3 from_a = position - t.corners.a;
  const bool keeps_insets = glm::dot(from_a, t.inwards[0]) >= t.min_inwards[0] &&
                            glm::dot(from_a, t.inwards[1]) >= t.min_inwards[1] &&
                            glm::dot(from_a, t.inwards[2]) >= t.min_inwards[2];
  if (!keeps_insets) return origin_near_edge(t, position, t.has_area() ? side * t.normal : surfel_normal);
  return {position + (side * t.offset - glm::dot(from_a, t.normal)) * t.normal, side * t.normal, t.offset,
          t.clear_cosine};
}

}  // namespace umbrameter
