#include "raytrace/frame_causes.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "raytrace/surface_judge.h"
#include "raytrace/surfel.h"
#include "raytrace/tracer_state.h"

namespace umbrameter {
namespace {

constexpr std::uint32_t whole_weight = 1u << 24;
constexpr int directions = 8;

// What the light sees around a point, as a map would store it.
class Sight {
 public:
  Sight(const Tracer& tracer, const MapLayout& layout)
      : tracer_(tracer), layout_(layout), world_from_light_(glm::inverse(layout.light_from_world)) {}

  double depth(const dvec3& local) const { return is_omnidirectional(layout_.kind) ? glm::length(local) : -local.z; }

  // In light space, `reach` metres from the point and in one of the directions across the light's rays.
  dvec3 beside(const dvec3& local, double reach, int direction) const {
    const double angle = 2.0 * pi * (direction + 0.5) / directions;
    const dvec2 step = reach * dvec2(std::cos(angle), std::sin(angle));
    if (!is_omnidirectional(layout_.kind)) return local + dvec3(step, 0.0);
    const dvec3 axis = glm::normalize(local);
    const dvec3 helper = std::abs(axis.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
    const dvec3 right = glm::normalize(glm::cross(helper, axis));
    return local + step.x * right + step.y * glm::cross(axis, right);
  }

  // The first surface on the light's ray through the point.
  std::optional<SurfacePoint> first_on_ray(const dvec3& through) const {
    const bool is_parallel = layout_.kind == MapKind::orthographic;
    const dvec3 from = is_parallel ? dvec3(through.x, through.y, 0.0) : dvec3(0.0);
    const dvec3 way = is_parallel ? dvec3(0.0, 0.0, -1.0) : glm::normalize(through);
    RayQuery query;
    prepare(query, tracer_.state(), false);
    query.own_instance[0] = no_id;
    query.own_triangle[0] = no_id;
    const vec3 origin(dvec3(world_from_light_ * dvec4(from, 1.0)));
    const vec3 direction(dmat3(world_from_light_) * way);
    const NearestHit hit = nearest_hit(query, origin, direction, std::numeric_limits<float>::infinity());
    if (hit.instance == no_id) return std::nullopt;
    const dvec3 world = dvec3(origin) + static_cast<double>(hit.distance) * dvec3(direction);
    return SurfacePoint{dvec3(layout_.light_from_world * dvec4(world, 1.0)), hit.instance, hit.triangle};
  }

 private:
  const Tracer& tracer_;
  const MapLayout& layout_;
  dmat4 world_from_light_;
};

}  // namespace

WrongTaps causes_by_rays(const Tracer& tracer, const GBuffer& gbuffer, const MapLayout& layout,
                         const Image<PixelExclusion>& exclusion, const Image<float>& truth, const Image<float>& drawn,
                         const Progress& progress) {
  WrongTaps wrong{Image<uvec4>(gbuffer.width, gbuffer.height, uvec4(0)), whole_weight};
  struct WrongPixel {
    std::size_t pixel = 0;
    std::uint32_t weight = 0;
    bool is_dark = false;
    Cause cause = Cause::acne;
    std::optional<TapSurfaces> tested{};
  };
  std::vector<WrongPixel> pixels;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (exclusion[i] != PixelExclusion::none) continue;
    const double error = static_cast<double>(drawn[i]) - static_cast<double>(truth[i]);
    const auto weight = static_cast<std::uint32_t>(std::lround(std::min(std::abs(error), 1.0) * whole_weight));
    if (weight > 0) pixels.push_back({i, weight, error < 0.0});
  }
  const Sight sight(tracer, layout);
  parallel_for(pixels.size(), [&](std::size_t n) {
    WrongPixel& each = pixels[n];
    const dvec3 position(gbuffer.position[each.pixel]);
    const dvec3 local(layout.light_from_world * dvec4(position, 1.0));
    const double texel = texel_at(layout, position);
    const dvec3 normal = dmat3(layout.light_from_world) * dvec3(gbuffer.geometric_normal[each.pixel]);
    const double own_depth = sight.depth(local);
    double nearest = own_depth;
    bool is_lit_beside = false;
    for (const double reach : frame_cause_reaches) {
      for (int direction = 0; direction < directions; ++direction) {
        const std::optional<SurfacePoint> seen = sight.first_on_ray(sight.beside(local, reach * texel, direction));
        const double depth = seen ? sight.depth(seen->in_light) : std::numeric_limits<double>::infinity();
        // A blocker stands above the pixel's plane; what lies on it is the pixel's surface, lit.
        const bool blocks = seen && glm::dot(seen->in_light - local, normal) > 1e-3 * texel && depth < own_depth;
        if (reach == frame_cause_reaches[0] && !blocks) is_lit_beside = true;
        if (!seen || !(depth < nearest)) continue;
        nearest = depth;
        each.tested = TapSurfaces{{local, gbuffer.instance[each.pixel], gbuffer.triangle[each.pixel]}, *seen};
      }
    }
    if (each.is_dark) return;
    each.cause = is_lit_beside ? Cause::light_leak : Cause::peter_panning;
    each.tested.reset();
  });
  std::vector<TapSurfaces> tested;
  for (const WrongPixel& each : pixels) {
    if (each.tested) tested.push_back(*each.tested);
  }
  const std::vector<std::uint8_t> is_own = test_same_surface(tracer, layout, tested, Continuity::seen, progress);
  std::size_t next = 0;
  for (WrongPixel& each : pixels) {
    if (each.tested && is_own[next++] == 0) each.cause = Cause::false_occlusion;
    wrong.weights[each.pixel][static_cast<int>(each.cause)] = each.weight;
  }
  return wrong;
}

}  // namespace umbrameter
