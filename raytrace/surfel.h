// From a G-buffer pixel to the point that its rays leave from. For raytrace/*.cpp and tests.
#pragma once

#include <array>
#include <cmath>

#include "core/gbuffer.h"
#include "raytrace/tracer.h"
#include "raytrace/vectors.h"

namespace umbrameter {

/// The exact surface point of a pixel and the step off it.
struct RayOrigin {
  /// `offset` over the surfel's foot on its own triangle, which is a few offsets in from the edges; world.
  dvec3 point;
  dvec3 normal;       ///< unit, of the triangle, on the side of the surfel's geometric normal
  double offset = 0;  ///< metres along the normal
  /// A ray at least this cosine off the normal's plane cannot meet its own triangle, however Embree rounds; above 1
  /// when nothing is known.
  double clear_cosine = 2;
};

/// Whether a ray of that direction cannot meet its own triangle, by normal and clear_cosine of its RayOrigin.
inline bool is_clear(const dvec3& normal, double clear_cosine, const vec3& direction) {
  return glm::dot(normal, dvec3(direction)) > clear_cosine;
}

/// Largest distance by which a vertex of the triangle may stand off its ideal place, metres, world.
double vertex_error(const Scene& scene, std::uint32_t instance, std::uint32_t triangle);

/// What is the same for every pixel of a triangle.
struct SurfelTriangle {
  std::uint32_t instance;
  std::uint32_t id;
  Triangle corners;
  /// Unit vectors, side by side: three in the plane, off the edges that start at a, b and c, and the triangle's normal.
  /// Zero where it has no area.
  Four x, y, z;
  /// Metres by which a point must stand from corner a along each of them to be as far in as an origin: −∞ for the
  /// normal, ∞ for the others without an area and of a huge triangle.
  Four least;
  std::array<double, 3> insets;  ///< metres that an origin keeps off those edges; infinite without an area
  double offset;                 ///< metres: RayOrigin::offset, of a huge triangle at the world's origin
  double clear_cosine;           ///< RayOrigin::clear_cosine
  /// Of a huge triangle, what RayOrigin::offset gains with the magnitudes of the origin's coordinates. Zero of others,
  /// which have one offset.
  dvec3 offset_gain;
  dvec3 inwards(int edge) const { return {x[edge], y[edge], z[edge]}; }
  dvec3 normal() const { return {x[3], y[3], z[3]}; }
  bool has_area() const { return normal() != dvec3(0.0); }
  bool is_huge() const { return offset_gain != dvec3(0.0); }
};

/// The triangles that the pixels of a tile have met. Described many at a time, where the caller can wait, one takes
/// less than half as long.
class SurfelTable {
 public:
  using Place = std::uint16_t;
  static constexpr std::size_t capacity = 512;

  explicit SurfelTable(const Tracer& tracer) : tracer_(tracer) { clear(); }

  /// Forgets all unless that many more triangles fit, up to capacity.
  void make_room(std::size_t triangles) {
    if (size_ + triangles > capacity) clear();
  }
  /// Where the triangle is in the table; there is room, and it is described by the next describe().
  Place place_of(std::uint32_t instance, std::uint32_t id) {
    const std::uint64_t key = (static_cast<std::uint64_t>(instance) << 32u) | id;
    std::size_t bucket = (id + 29u * instance) % keys_.size();
    for (; keys_[bucket] != key; bucket = (bucket + 1) % keys_.size()) {
      if (keys_[bucket] != no_key) continue;
      keys_[bucket] = key;
      places_[bucket] = static_cast<Place>(size_);
      triangles_[size_].instance = instance;
      triangles_[size_].id = id;
      ++size_;
      break;
    }
    return places_[bucket];
  }
  void describe();
  const SurfelTriangle& operator[](Place place) const { return triangles_[place]; }

  /// All of that for one triangle.
  const SurfelTriangle& get(std::uint32_t instance, std::uint32_t id) {
    make_room(1);
    const Place place = place_of(instance, id);
    if (described_ < size_) describe();
    return triangles_[place];
  }

 private:
  static constexpr std::uint64_t no_key = ~std::uint64_t{0};  // no_id twice

  void clear() {
    size_ = described_ = 0;
    keys_.fill(no_key);
  }

  const Tracer& tracer_;
  std::size_t size_ = 0;
  std::size_t described_ = 0;
  std::array<std::uint64_t, 2 * capacity> keys_;  // at most half in use, so that a search is short
  std::array<Place, 2 * capacity> places_;
  std::array<SurfelTriangle, capacity> triangles_;  // the first size_ are in use
};

/// The origin over the point of the triangle that is nearest to the position and as far in from the edges as an origin
/// keeps. By value: an origin whose address is taken stays in memory, also where this is not called.
RayOrigin origin_off_foot(const SurfelTriangle& t, const dvec3& position, const dvec3& normal);

/// In the header for speed: it is asked for every ray of a shadow.
UMBRAMETER_IN_VECTORS RayOrigin origin_on(const SurfelTriangle& t, const GBuffer& gbuffer, std::size_t pixel) {
  const dvec3 position(gbuffer.position[pixel]);
  const dvec3 seen(gbuffer.geometric_normal[pixel]);
  RayOrigin origin;
  origin.offset = t.offset;
  origin.clear_cosine = t.clear_cosine;
  const dvec3 from_a = position - t.corners.a;
  const dvec3 normal = t.normal();
  const double side = std::copysign(1.0, glm::dot(normal, seen));
  origin.normal = side * normal;
  const Four along = from_a.x * t.x + from_a.y * t.y + from_a.z * t.z;
  const auto is_in = along >= t.least;
  // Most are: then the triangle's nearest point is the foot of the perpendicular. Of a huge triangle none is.
  if ((is_in[0] & is_in[1] & is_in[2] & is_in[3]) != 0) {
    origin.point = position + (side * t.offset - along[3]) * normal;
    return origin;
  }
  return origin_off_foot(t, position, t.has_area() ? side * normal : seen);
}

/// With a step after which rounding cannot put a ray behind the surface that it leaves: one bound for all points of a
/// triangle, unless it is huge.
RayOrigin ray_origin(const Tracer& tracer, const GBuffer& gbuffer, std::size_t pixel);
/// The same, faster where pixels share triangles.
inline RayOrigin ray_origin(const GBuffer& gbuffer, std::size_t pixel, SurfelTable& table) {
  return origin_on(table.get(gbuffer.instance[pixel], gbuffer.triangle[pixel]), gbuffer, pixel);
}

}  // namespace umbrameter
