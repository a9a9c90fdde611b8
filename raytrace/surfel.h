// From a G-buffer pixel to the point that its rays leave from. For raytrace/*.cpp alone.
#pragma once

#include <array>

#include "core/gbuffer.h"
#include "raytrace/tracer.h"

namespace umbrameter {

/// The exact surface point of a pixel and the step off it.
struct RayOrigin {
  dvec3 surface;      ///< the surfel projected onto its own triangle, a few offsets in from its edges, world
  dvec3 normal;       ///< unit, of the triangle, on the side of the surfel's geometric normal
  double offset = 0;  ///< metres along the normal
  /// A ray at least this cosine off the normal's plane cannot meet its own triangle, however Embree rounds; above 1
  /// when nothing is known.
  double clear_cosine = 2;
  dvec3 point() const { return surface + offset * normal; }
};

/// Whether a ray of that direction cannot meet its own triangle, by normal and clear_cosine of its RayOrigin.
inline bool is_clear(const dvec3& normal, double clear_cosine, const vec3& direction) {
  return glm::dot(normal, dvec3(direction)) > clear_cosine;
}

/// Largest distance by which a vertex of the triangle may stand off its ideal place, metres, world.
double vertex_error(const Scene& scene, std::uint32_t instance, std::uint32_t triangle);

/// What is the same for every pixel of a triangle.
struct SurfelTriangle {
  std::uint32_t instance = no_id;
  std::uint32_t id = no_id;
  Triangle corners;
  double twice_area = 0;
  dvec3 normal{0};                  ///< unit; zero where the triangle has no area
  std::array<dvec3, 3> inwards{};   ///< unit, in the plane, off the edges that start at a, b and c
  std::array<double, 3> heights{};  ///< metres over those edges
  std::array<double, 3> insets{};   ///< metres that an origin keeps off those edges
  double offset = 0;                ///< metres: RayOrigin::offset
  double clear_cosine = 2;          ///< RayOrigin::clear_cosine
};

/// The triangles that the pixels of a tile have met, of one scene.
class SurfelCache {
 public:
  const SurfelTriangle& get(const Tracer& tracer, std::uint32_t instance, std::uint32_t id) {
    SurfelTriangle& slot = slots_[(id + 29u * instance) % slots_.size()];
    if (slot.instance != instance || slot.id != id) fill(slot, tracer, instance, id);
    return slot;
  }

 private:
  static void fill(SurfelTriangle& slot, const Tracer& tracer, std::uint32_t instance, std::uint32_t id);

  std::array<SurfelTriangle, 64> slots_;
};

/// The point of the triangle that is nearest to a position, and as far in from its edges as an origin keeps.
dvec3 surface_point(const SurfelTriangle& t, const dvec3& position);

/// Whether a point, seen from corner a, stands over the triangle and that far in.
inline bool is_well_within(const SurfelTriangle& t, const dvec3& from_a) {
  const bool over_ab = glm::dot(from_a, t.inwards[0]) >= t.insets[0];
  const bool over_bc = glm::dot(from_a, t.inwards[1]) + t.heights[1] >= t.insets[1];
  const bool over_ca = glm::dot(from_a, t.inwards[2]) >= t.insets[2];
  return over_ab & over_bc & over_ca;
}

/// In the header for speed: it is asked for every ray of a shadow.
inline RayOrigin origin_on(const SurfelTriangle& t, const GBuffer& gbuffer, std::size_t pixel) {
  const dvec3 position(gbuffer.position[pixel]);
  const dvec3 seen(gbuffer.geometric_normal[pixel]);
  RayOrigin origin;
  origin.offset = t.offset;
  origin.clear_cosine = t.clear_cosine;
  if (!(t.twice_area > 0.0)) {
    origin.normal = seen;
    origin.surface = surface_point(t, position);
    return origin;
  }
  const dvec3 from_a = position - t.corners.a;
  origin.normal = glm::dot(t.normal, seen) < 0.0 ? -t.normal : t.normal;
  // Most surfels: then the triangle's nearest point is the foot of the perpendicular.
  origin.surface =
      is_well_within(t, from_a) ? position - glm::dot(from_a, t.normal) * t.normal : surface_point(t, position);
  return origin;
}

/// With a step after which rounding cannot put a ray behind the surface that it leaves: one bound for all points of a
/// triangle.
RayOrigin ray_origin(const Tracer& tracer, const GBuffer& gbuffer, std::size_t pixel);
/// The same, faster where pixels share triangles.
inline RayOrigin ray_origin(const Tracer& tracer, const GBuffer& gbuffer, std::size_t pixel, SurfelCache& cache) {
  return origin_on(cache.get(tracer, gbuffer.instance[pixel], gbuffer.triangle[pixel]), gbuffer, pixel);
}

}  // namespace umbrameter
