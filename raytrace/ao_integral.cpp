#include "raytrace/ao_integral.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <mutex>

#include "core/random.h"
#include "raytrace/ao_samples.h"
#include "raytrace/packet.h"
#include "raytrace/surfel.h"
#include "raytrace/visible_surface.h"

namespace umbrameter {
namespace {

constexpr int tile_size = 16;

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

class IntegralTile {
 public:
  IntegralTile(const Tracer& tracer, const GBuffer& gbuffer, const VisibleSurface& surface, const AoIntegral& integral,
               const AoIntegralParams& params)
      : gbuffer_(gbuffer),
        surface_(surface),
        integral_(integral),
        params_(params),
        split_(split(params.spp)),
        packet_(tracer.state()),
        triangles_(tracer) {
    directions_.ao_weight = integral.directions == AoDirections::cosine ? AoWeight::cosine : AoWeight::uniform;
  }

  void trace(const Tile& tile, TracedIntegral& result) {
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
      for (int x = tile.x_begin; x < tile.x_end; ++x) {
        const std::size_t i = gbuffer_.instance.index(x, y);
        if (gbuffer_.is_surface(i)) trace_pixel(i, result);
      }
    }
  }

  const TraceStatistics& statistics() const { return statistics_; }

 private:
  void trace_pixel(std::size_t pixel, TracedIntegral& result) {
    const RayOrigin origin = ray_origin(gbuffer_, pixel, triangles_);
    Hemisphere hemisphere;
    hemisphere.normal = vec3(origin.normal);
    hemisphere.frame = frame_about(hemisphere.normal);
    hemisphere.offset = origin.offset;
    hemisphere.reach = integral_.reach;
    hemisphere.clear_cosine = static_cast<float>(origin.clear_cosine) + 0x1p-20f;
    statistics_.largest_offset = std::max(statistics_.largest_offset, origin.offset);
    packet_.set_own_triangle(gbuffer_.instance[pixel], gbuffer_.triangle[pixel]);
    const PixelRays rays{vec3(origin.point), {split_, 0}, hash(static_cast<std::uint32_t>(pixel), 0u, params_.seed)};
    samples_.make(directions_, hemisphere, std::span(&rays, 1));
    normal_ = glm::normalize(surface_.view_from_world() * dvec3(origin.normal));
    viewer_ = surface_.to_viewer(pixel);
    occlusion_.fill({});
    for (std::size_t first = 0; first < samples_.size(); first += packet_width) {
      const std::size_t count = std::min(samples_.size() - first, packet_width);
      samples_.lift(first, packet_.lanes(), lifted_);
      packet_.use(count, lifted_.are_clear);
      directions_of(count);
      packet_.trace();
      for (std::size_t lane = 0; lane < count; ++lane) {
        Means& sums = occlusion_[samples_.source(first + lane) % max_randomisations];
        const Means ray = occlusion_of(pixel, lane);
        for (std::size_t k = 0; k < occluder_kinds; ++k) sums[k] += ray[k];
      }
    }
    statistics_.rays += samples_.size();
    store(pixel, result);
  }

  void directions_of(std::size_t count) {
    const RayLanes rays = packet_.lanes();
    for (std::size_t lane = 0; lane < count; ++lane) {
      const dvec3 world(rays.dx[lane], rays.dy[lane], rays.dz[lane]);
      ray_directions_[lane] = glm::normalize(surface_.view_from_world() * world);
    }
  }

  // `point`: from the surfel to the point of the surface.
  AoHit hit_at(const dvec3& direction, double along_ray, const dvec3& point) const {
    const double up = glm::dot(direction, viewer_);
    const dvec3 across = direction - up * viewer_;
    const double length = glm::length(across);
    const dvec3 towards = length > 0.0 ? across / length : dvec3(0.0);
    const double tangent = -std::atan2(glm::dot(normal_, towards), glm::dot(normal_, viewer_));
    const double distance = glm::length(point);
    return {along_ray, distance, distance > 0.0 ? glm::dot(point, normal_) / distance : 0.0,
            std::asin(std::clamp(up, -1.0, 1.0)) - tangent, std::abs(point.z)};
  }

  Means occlusion_of(std::size_t pixel, std::size_t lane) const {
    Means occlusion{};
    const dvec3& direction = ray_directions_[lane];
    constexpr auto all = static_cast<std::size_t>(Occluders::all);
    constexpr auto in_view = static_cast<std::size_t>(Occluders::in_view);
    constexpr auto seen = static_cast<std::size_t>(Occluders::seen);
    constexpr auto solid = static_cast<std::size_t>(Occluders::solid);
    if (packet_.is_blocked(lane)) {
      const double distance =
          std::max(static_cast<double>(packet_.distance(lane)) + static_cast<double>(lifted_.step[lane]), 0.0);
      occlusion[all] = integral_.occlusion(hit_at(direction, distance, distance * direction));
      // The view volume is convex: a ray that has left it does not come back.
      if (distance <= surface_.reach_in_view(pixel, direction, integral_.reach)) occlusion[in_view] = occlusion[all];
    }
    const auto visit = [&](const SurfaceEvent& event) {
      const double weight =
          integral_.occlusion(hit_at(direction, event.distance, event.seen - surface_.position(pixel)));
      // Behind a distant surface, which occludes little, a nearer one may occlude more.
      occlusion[solid] = std::max(occlusion[solid], weight);
      if (event.is_connected) occlusion[seen] = weight;
      return !event.is_connected;
    };
    surface_.march(pixel, direction, integral_.reach, params_.thickness, std::cref(visit));
    return occlusion;
  }

  void store(std::size_t pixel, TracedIntegral& result) const {
    const auto count = static_cast<std::size_t>(split_.count);
    Means mean{};
    std::array<Means, max_randomisations> open{};
    for (std::size_t r = 0; r < count; ++r) {
      for (std::size_t k = 0; k < occluder_kinds; ++k) {
        open[r][k] = 1.0 - occlusion_[r][k] / split_.size(static_cast<int>(r));
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
      result.accessibility[k][pixel] = static_cast<float>(output[k].value);
      result.variance[k][pixel] = static_cast<float>(output[k].slope * output[k].slope * variance[k]);
      result.step_variance[k][pixel] = static_cast<float>(of_step);
    }
    result.samples[pixel] = static_cast<float>(split_.points);
  }

  const GBuffer& gbuffer_;
  const VisibleSurface& surface_;
  const AoIntegral& integral_;
  const AoIntegralParams& params_;
  TruthParams directions_;
  Randomisations split_;
  HitPacket packet_;
  TriangleCache triangles_;
  HemisphereSamples samples_;
  LiftedLanes lifted_;
  dvec3 normal_{0, 0, 1};
  dvec3 viewer_{0, 0, 1};
  std::array<dvec3, packet_width> ray_directions_{};
  std::array<Means, max_randomisations> occlusion_{};
  TraceStatistics statistics_;
};

}  // namespace

TracedIntegral trace_integral(const Tracer& tracer, const GBuffer& gbuffer, const View& view,
                              const AoIntegral& integral, const AoIntegralParams& params, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  TracedIntegral traced;
  for (std::size_t k = 0; k < occluder_kinds; ++k) {
    traced.accessibility[k] = Image<float>(gbuffer.width, gbuffer.height, 1.0f);
    traced.variance[k] = traced.step_variance[k] = Image<float>(gbuffer.width, gbuffer.height, 0.0f);
  }
  traced.samples = Image<float>(gbuffer.width, gbuffer.height, 0.0f);
  traced.degrees_of_freedom = split(params.spp).count - 1;
  const VisibleSurface surface(gbuffer, view);
  std::mutex mutex;
  parallel_tiles(
      gbuffer.width, gbuffer.height, tile_size,
      [&](const Tile& tile) {
        IntegralTile pixels(tracer, gbuffer, surface, integral, params);
        pixels.trace(tile, traced);
        tracer.state().rays_traced += pixels.statistics().rays;
        const std::lock_guard lock(mutex);
        traced.statistics.add(pixels.statistics());
      },
      progress);
  traced.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return traced;
}

}  // namespace umbrameter
