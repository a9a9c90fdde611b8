#include "raytrace/surface_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

#include "raytrace/surfel.h"
#include "raytrace/tracer_state.h"

namespace umbrameter {
namespace {

// A point that the light sees, on the plane of its triangle.
struct SeenPoint {
  dvec3 in_light{0.0};
  double depth = 0.0;  // metres, as in the map
  dvec3 corner{0.0};   // of the triangle, light space
  dvec3 normal{0.0};   // unit, light space; zero if the triangle has no area
  std::uint32_t instance = no_id;
  std::uint32_t triangle = no_id;
  double width = 0.0;  // metres across the ray: rays closer than this are indistinguishable
  double error = 0.0;  // bound on the rounding error of the depth, metres
};

struct LightRay {
  dvec3 origin{0.0};
  dvec3 direction{0.0, 0.0, -1.0};  // unit
};

class Judge {
 public:
  Judge(const Tracer& tracer, const MapLayout& layout, Continuity continuity)
      : tracer_(tracer),
        layout_(layout),
        continuity_(continuity),
        world_from_light_(glm::inverse(layout.light_from_world)) {
    const std::vector<Instance>& instances = tracer.scene().instances;
    const auto& masks = tracer.state().mesh_masks;
    has_masks_ = std::ranges::any_of(instances, [&](const auto& i) { return masks[i.mesh] != nullptr; });
  }

  // Continuity::seen is for receivers that are lit in the reference: the light sees the receiver, so if the sample is
  // on its surface, the light sees continuous depths between them. At a blocked receiver the light sees another
  // surface, so there is always a jump.
  bool is_same_surface(const TapSurfaces& tap) const {
    SeenPoint a = seen(tap.receiver);
    SeenPoint b = seen(tap.sample);
    // Terminates: a double has no more digits than a segment can be halved.
    for (int i = 0; i < std::numeric_limits<double>::digits; ++i) {
      if (a.instance == b.instance && a.triangle == b.triangle) return true;
      if (distance_across(a, b) <= a.width + b.width) break;
      const LightRay ray = between(a, b);
      const std::optional<SeenPoint> middle = continuity_ == Continuity::seen ? first_seen(ray) : layer_on(ray, a, b);
      if (!middle) return false;
      (step_between(a, *middle) >= step_between(*middle, b) ? b : a) = *middle;
    }
    return is_continuous(a, b);
  }

 private:
  bool is_orthographic() const { return layout_.kind == MapKind::orthographic; }

  double depth(const dvec3& p) const { return is_omnidirectional(layout_.kind) ? glm::length(p) : -p.z; }

  LightRay ray_through(const dvec3& p) const {
    if (is_orthographic()) return {{p.x, p.y, 0.0}, {0.0, 0.0, -1.0}};
    return {dvec3(0.0), glm::normalize(p)};
  }

  // A straight line on a map's plane, or across the faces of a cube map, spans a plane with the light, and halving the
  // angle stays on this plane.
  LightRay between(const SeenPoint& a, const SeenPoint& b) const {
    if (is_orthographic()) return ray_through(0.5 * (a.in_light + b.in_light));
    return ray_through(glm::normalize(a.in_light) + glm::normalize(b.in_light));
  }

  // Metres across the light's rays, at the nearer of the two.
  double distance_across(const SeenPoint& a, const SeenPoint& b) const {
    if (is_orthographic()) return glm::length(dvec2(a.in_light - b.in_light));
    const double reach = std::min(glm::length(a.in_light), glm::length(b.in_light));
    return reach * glm::length(glm::normalize(a.in_light) - glm::normalize(b.in_light));
  }

  static double distance_to_plane(const SeenPoint& plane, const LightRay& ray) {
    return glm::dot(plane.normal, plane.corner - ray.origin) / glm::dot(plane.normal, ray.direction);
  }

  // The error across the ray: its origin and direction are rounded once, and Embree's differences to the corners, dot
  // products and normal are at most eight roundings of lengths up to the distance (as in surfel.cpp); a shared mesh
  // adds the transform to its space. The error of the vertices moves the plane. The error of the depth is at most the
  // sum of both over the cosine to the light, because a point on a plane that moves by w across the ray moves by at
  // most w / cosine in space.
  void set_errors(SeenPoint& point, const LightRay& ray) const {
    const InstanceInfo& info = tracer_.state().instances[point.instance];
    const dvec3 origin = glm::abs(dvec3(world_from_light_ * dvec4(ray.origin, 1.0)));
    const double distance = glm::length(point.in_light - ray.origin);
    point.width = half_ulp * (glm::length(origin) + 8.0 * distance);
    if (info.is_shared) {
      const dvec3 along = distance * glm::abs(dmat3(world_from_light_) * ray.direction);
      point.width += glm::length(info.origin_error.linear * (origin + along) + info.origin_error.constant);
    }
    const double cosine = std::abs(glm::dot(point.normal, ray.direction));
    const double moved = point.width + vertex_error(tracer_.scene(), point.instance, point.triangle);
    point.error = cosine > 0.0 ? moved / cosine : std::numeric_limits<double>::infinity();
  }

  SeenPoint on_triangle(std::uint32_t instance, std::uint32_t id) const {
    SeenPoint point;
    point.instance = instance;
    point.triangle = id;
    const Triangle t = world_triangle(tracer_.scene(), instance, id);
    const dmat3 turn(layout_.light_from_world);
    point.corner = dvec3(layout_.light_from_world * dvec4(t.a, 1.0));
    const dvec3 across = glm::cross(turn * (t.b - t.a), turn * (t.c - t.a));
    const double twice_area = glm::length(across);
    if (twice_area > 0.0) point.normal = across / twice_area;
    return point;
  }

  SeenPoint seen(const SurfacePoint& given) const {
    SeenPoint point = on_triangle(given.instance, given.triangle);
    point.in_light = given.in_light;
    point.depth = depth(given.in_light);
    set_errors(point, ray_through(given.in_light));
    return point;
  }

  // A ray of the light, rounded to floats for Embree.
  struct WorldRay {
    vec3 origin;
    vec3 direction;
  };
  WorldRay rounded(const LightRay& ideal) const {
    return {vec3(dvec3(world_from_light_ * dvec4(ideal.origin, 1.0))),
            vec3(dmat3(world_from_light_) * ideal.direction)};
  }

  // The nearest hit along a ray of the light, if any.
  std::optional<SeenPoint> first_seen(const LightRay& ideal) const {
    RayQuery query;
    prepare(query, tracer_.state(), false);
    query.own_instance[0] = no_id;
    query.own_triangle[0] = no_id;
    if (!has_masks_) filter_every_hit(query, false);
    const WorldRay ray = rounded(ideal);
    const NearestHit hit = nearest_hit(query, ray.origin, ray.direction, std::numeric_limits<float>::infinity());
    if (hit.instance == no_id) return std::nullopt;
    return hit_point(ray, hit, static_cast<double>(hit.distance));
  }

  // Of all surfaces along a ray of the light, the one whose depth the planes of both points explain best.
  std::optional<SeenPoint> layer_on(const LightRay& ideal, const SeenPoint& a, const SeenPoint& b) const {
    constexpr int most_layers = 64;
    RayQuery query;
    prepare(query, tracer_.state(), false);
    filter_every_hit(query, true);
    const WorldRay ray = rounded(ideal);
    NearestHit last;
    last.instance = no_id;
    last.triangle = no_id;
    double travelled = 0.0;
    std::optional<SeenPoint> best;
    double least = std::numeric_limits<double>::infinity();
    for (int layer = 0; layer < most_layers; ++layer) {
      // From the last hit, which leaves out its own triangle.
      query.own_instance[0] = last.instance;
      query.own_triangle[0] = last.triangle;
      const vec3 origin(dvec3(ray.origin) + travelled * dvec3(ray.direction));
      last = nearest_hit(query, origin, ray.direction, std::numeric_limits<float>::infinity());
      if (last.instance == no_id) break;
      travelled += static_cast<double>(last.distance);
      const SeenPoint point = hit_point(ray, last, travelled);
      const double steps = step_between(a, point) + step_between(point, b);
      if (steps < least) {
        least = steps;
        best = point;
      }
    }
    return best;
  }

  // The position is the intersection of the triangle's plane with the ray, in double precision.
  SeenPoint hit_point(const WorldRay& traced, const NearestHit& hit, double distance) const {
    SeenPoint point = on_triangle(hit.instance, hit.triangle);
    const LightRay ray{dvec3(layout_.light_from_world * dvec4(dvec3(traced.origin), 1.0)),
                       glm::normalize(dmat3(layout_.light_from_world) * dvec3(traced.direction))};
    const double exact = distance_to_plane(point, ray);
    point.in_light = ray.origin + ray.direction * (std::isfinite(exact) ? exact : distance);
    point.depth = depth(point.in_light);
    set_errors(point, ray);
    return point;
  }

  // Depth of the plane of one point on the ray through the other.
  double depth_on(const SeenPoint& plane, const SeenPoint& other) const {
    const LightRay ray = ray_through(other.in_light);
    return depth(ray.origin + ray.direction * distance_to_plane(plane, ray));
  }

  // The depth step that neither plane explains: zero on a plane of any slope, shrinking with the square of the distance
  // on a curved surface, and the full step at a jump. The plain depth difference would be dominated by slopes.
  double step_between(const SeenPoint& a, const SeenPoint& b) const {
    const double from_a = std::abs(depth_on(a, b) - b.depth);
    const double from_b = std::abs(depth_on(b, a) - a.depth);
    return std::min(from_a, from_b);
  }

  // For points that rays can hardly distinguish: on one surface, the depth step is at most the step along the steeper
  // of the two planes plus the rounding errors.
  bool is_continuous(const SeenPoint& a, const SeenPoint& b) const {
    const double step = std::abs(b.depth - a.depth);
    const double slope = std::max(std::abs(depth_on(a, b) - a.depth), std::abs(depth_on(b, a) - b.depth));
    return step <= slope + a.error + b.error;
  }

  const Tracer& tracer_;
  const MapLayout& layout_;
  Continuity continuity_;
  dmat4 world_from_light_;
  bool has_masks_ = false;
};

}  // namespace

std::vector<std::uint8_t> test_same_surface(const Tracer& tracer, const MapLayout& layout,
                                            std::span<const TapSurfaces> taps, Continuity continuity,
                                            const Progress& progress) {
  constexpr std::size_t batch = 256;
  const Judge judge(tracer, layout, continuity);
  std::vector<std::uint8_t> is_same(taps.size());
  const std::size_t batches = (taps.size() + batch - 1) / batch;
  std::size_t done = 0;
  std::mutex mutex;
  parallel_for(batches, [&](std::size_t b) {
    const std::size_t end = std::min(taps.size(), (b + 1) * batch);
    for (std::size_t i = b * batch; i < end; ++i) is_same[i] = judge.is_same_surface(taps[i]) ? 1 : 0;
    if (!progress) return;
    const std::lock_guard lock(mutex);
    progress(static_cast<double>(++done) / static_cast<double>(batches));
  });
  return is_same;
}

}  // namespace umbrameter
