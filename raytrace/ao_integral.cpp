#include "raytrace/ao_integral.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "raytrace/ao_tile.h"
#include "raytrace/visible_surface.h"

namespace umbrameter {
namespace {

using Means = std::array<double, occluder_kinds>;

// The output at a mean that has noise: its value without the bias that noise of this standard error gives a curved or
// bent output, and its slope over the noise. Two points at ±1 standard error give both to second order.
struct Output {
  double value = 0.0;
  double slope = 0.0;
};
Output output_at(const AoIntegral& integral, std::size_t pixel, double accessibility, double standard_error) {
  const auto shown = [&](double at) {
    const double output = integral.output(at);
    return integral.shown ? integral.shown(output, pixel) : output;
  };
  const double h = std::max(standard_error, 1e-4);
  const double value = shown(accessibility);
  const double before = shown(accessibility - h);
  const double after = shown(accessibility + h);
  return {2.0 * value - 0.5 * (before + after), (after - before) / (2.0 * h)};
}

// The integral by each set of occluders.
class Integral {
 public:
  using Rays = HitPacket;
  struct Sums {
    std::size_t pixel = 0;
    dvec3 normal{0, 0, 1};  // in view space, as `viewer`
    dvec3 viewer{0, 0, 1};
    std::array<Means, max_randomisations> occlusion{};
  };

  Integral(const VisibleSurface& surface, const AoIntegral& integral, int spp, TracedIntegral& result)
      : surface_(surface), integral_(integral), split_(split(spp)), result_(result) {}

  Sums start(std::size_t pixel, const RayOrigin& origin) const {
    return {pixel, glm::normalize(surface_.view_from_world() * origin.normal), surface_.to_viewer(pixel)};
  }

  double add(Sums& sums, const TracedRay& ray) const {
    const Means occlusion = occlusion_of(sums, ray);
    for (std::size_t k = 0; k < occluder_kinds; ++k) sums.occlusion[ray.randomisation][k] += occlusion[k];
    return 1.0 - occlusion[static_cast<std::size_t>(Occluders::all)];
  }

  void store(std::size_t pixel, const Sums& sums, const PixelEstimate& estimate) const {
    const auto count = static_cast<std::size_t>(split_.count);
    Means mean{};
    std::array<Means, max_randomisations> open{};
    for (std::size_t r = 0; r < count; ++r) {
      for (std::size_t k = 0; k < occluder_kinds; ++k) {
        open[r][k] = 1.0 - sums.occlusion[r][k] / split_.size(static_cast<int>(r));
        mean[k] += open[r][k] / static_cast<double>(count);
      }
    }
    const double scale = count > 1 ? 1.0 / static_cast<double>(count * (count - 1)) : 0.0;
    Means variance{};
    std::array<Output, occluder_kinds> output;
    for (std::size_t k = 0; k < occluder_kinds; ++k) {
      for (std::size_t r = 0; r < count; ++r) {
        const double off = open[r][k] - mean[k];
        variance[k] += off * off * scale;
      }
      output[k] = output_at(integral_, pixel, mean[k], std::sqrt(variance[k]));
    }
    for (std::size_t k = 0; k < occluder_kinds; ++k) {
      double of_step = 0.0;
      for (std::size_t r = 0; r < count; ++r) {
        double step = output[k].slope * (open[r][k] - mean[k]);
        if (k > 0) step -= output[k - 1].slope * (open[r][k - 1] - mean[k - 1]);
        of_step += step * step * scale;
      }
      result_.accessibility[k][pixel] = static_cast<float>(output[k].value);
      result_.variance[k][pixel] = static_cast<float>(output[k].slope * output[k].slope * variance[k]);
      result_.step_variance[k][pixel] = static_cast<float>(of_step);
    }
    result_.samples[pixel] = static_cast<float>(estimate.rays);
  }

 private:
  // `point`: from the surfel to the point of the surface, on the ray.
  static AoHit hit_at(const Sums& at, const dvec3& direction, double along_ray, const dvec3& point) {
    const double up = glm::dot(direction, at.viewer);
    const dvec3 across = direction - up * at.viewer;
    const double length = glm::length(across);
    const dvec3 towards = length > 0.0 ? across / length : dvec3(0.0);
    const double tangent = -std::atan2(glm::dot(at.normal, towards), glm::dot(at.normal, at.viewer));
    const double distance = glm::length(point);
    return {along_ray, distance, distance > 0.0 ? glm::dot(point, at.normal) / distance : 0.0,
            std::asin(std::clamp(up, -1.0, 1.0)) - tangent, std::abs(point.z)};
  }

  // `point`: likewise, on the ray or before it as the camera sees it.
  static AoHit hit_at(const Sums& at, const dvec3& direction, const SurfaceEvent& event, const dvec3& point) {
    AoHit hit = hit_at(at, direction, event.distance, point);
    if (event.is_connected) return hit;
    hit.behind = std::max(point.z - event.distance * direction.z, 0.0);
    // The point is a · direction + b · viewer, because the line of sight lies in the plane of the two: b.
    const double cosine = glm::dot(direction, at.viewer);
    const double square = 1.0 - cosine * cosine;
    const double up = glm::dot(point, at.viewer) - cosine * glm::dot(point, direction);
    hit.behind_to_viewer = square > 0.0 ? std::max(up / square, 0.0) : 0.0;
    return hit;
  }

  // How far along a ray it can be behind a point within the reach by no more than b = reach_behind. The point is
  // a · direction + b · viewer with a ≤ reach + b, and at the distance D from the viewer its line of sight meets the
  // ray at a · D / (D − b).
  double march_reach(std::size_t pixel) const {
    const double distance = surface_.distance_to_viewer(pixel);
    const double behind = std::min(integral_.reach_behind, 0.99 * distance);  // what the camera sees is before it
    return (integral_.reach + behind) * (std::isinf(distance) ? 1.0 : distance / (distance - behind));
  }

  Means occlusion_of(const Sums& at, const TracedRay& ray) const {
    Means occlusion{};
    const dvec3 direction = glm::normalize(surface_.view_from_world() * dvec3(ray.direction));
    constexpr auto all = static_cast<std::size_t>(Occluders::all);
    constexpr auto in_view = static_cast<std::size_t>(Occluders::in_view);
    constexpr auto seen = static_cast<std::size_t>(Occluders::seen);
    constexpr auto solid = static_cast<std::size_t>(Occluders::solid);
    if (ray.is_blocked) {
      occlusion[all] = integral_.occlusion(hit_at(at, direction, ray.distance, ray.distance * direction));
      // The view volume is convex: a ray that has left it does not come back.
      const double in_view_until = surface_.reach_in_view(at.pixel, direction, integral_.reach);
      if (ray.distance <= in_view_until) occlusion[in_view] = occlusion[all];
    }
    const auto visit = [&](const SurfaceEvent& event) {
      const double weight = integral_.occlusion(hit_at(at, direction, event, event.seen - surface_.position(at.pixel)));
      // Behind a distant surface, which occludes little, a nearer one may occlude more.
      occlusion[solid] = std::max(occlusion[solid], weight);
      const bool is_hit = event.is_connected && event.distance <= integral_.reach;
      if (is_hit) occlusion[seen] = weight;
      return !is_hit;
    };
    surface_.march(at.pixel, direction, march_reach(at.pixel), std::cref(visit));
    return occlusion;
  }

  const VisibleSurface& surface_;
  const AoIntegral& integral_;
  Randomisations split_;
  TracedIntegral& result_;
};

}  // namespace

TracedIntegral trace_integral(const Tracer& tracer, const GBuffer& gbuffer, const View& view,
                              const AoIntegral& integral, const AoIntegralParams& params, const Progress& progress) {
  TracedIntegral traced;
  for (std::size_t k = 0; k < occluder_kinds; ++k) {
    traced.accessibility[k] = Image<float>(gbuffer.width, gbuffer.height, 1.0f);
    traced.variance[k] = traced.step_variance[k] = Image<float>(gbuffer.width, gbuffer.height, 0.0f);
  }
  traced.samples = Image<float>(gbuffer.width, gbuffer.height, 0.0f);
  TruthParams rays;
  rays.spp = params.spp;
  rays.ao_weight = integral.directions == AoDirections::cosine ? AoWeight::cosine : AoWeight::uniform;
  traced.degrees_of_freedom = degrees_of_freedom(rays);
  const VisibleSurface surface(gbuffer, view);
  traced.statistics = trace_ao_tiles({tracer, gbuffer, rays, integral.reach, params.seed},
                                     Integral(surface, integral, params.spp, traced), progress);
  return traced;
}

}  // namespace umbrameter
