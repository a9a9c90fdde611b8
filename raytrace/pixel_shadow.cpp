#include "raytrace/pixel_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "raytrace/area_light.h"
#include "raytrace/packet.h"
#include "raytrace/primary_ray.h"
#include "raytrace/sampler.h"
#include "raytrace/shadow_ray_generator.h"
#include "raytrace/surfel.h"
#include "raytrace/visibility_tiles.h"
#include "raytrace/weighted_points.h"
#include "scenes/emitter.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

constexpr int pixel_tile_size = 16;
// Make the random numbers independent of those for other quantities at the same pixel.
constexpr std::uint32_t pixel_purpose = 0x41947u;
constexpr std::uint32_t pixel_pilot_purpose = 0x51947u;
constexpr std::uint32_t light_purpose = 0x61947u;

constexpr int fine_pixels = 4096;  // along a pixel's side: the points of a pixel are the centres of these

constexpr double max_sine = 0.5;           // of the angle between a plane and the way to a point of the same surface
constexpr double min_cosine = 0.70710678;  // between normals of one surface
constexpr double position_error = 1e-6;    // of a surfel in single precision, relative to its coordinates

bool is_same_surface(const GBuffer& gbuffer, std::size_t pixel, const PrimaryHit& hit) {
  if (hit.instance == no_id || hit.instance != gbuffer.instance[pixel]) return false;
  const dvec3 normal(gbuffer.geometric_normal[pixel]);
  if (glm::dot(normal, hit.normal) < min_cosine) return false;
  const dvec3 position(gbuffer.position[pixel]);
  const dvec3 offset = hit.position - position;
  return std::abs(glm::dot(normal, offset)) <=
         max_sine * glm::length(offset) + position_error * glm::length(hit.position);
}

class PixelTileTracer {
 public:
  PixelTileTracer(const Tracer& tracer, const GBuffer& gbuffer, const View& view, const Light& light,
                  const TruthSampling& sampling)
      : tracer_(tracer),
        gbuffer_(gbuffer),
        fine_view_{view.width * fine_pixels, view.height * fine_pixels, view.camera},
        light_(light),
        sampling_(sampling),
        to_center_(light),
        packet_(tracer.state()),
        triangles_(tracer) {}

  void trace(const Tile& tile, TracedVisibility& result) {
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
      for (int x = tile.x_begin; x < tile.x_end; ++x) {
        const std::size_t i = gbuffer_.instance.index(x, y);
        if (!gbuffer_.is_surface(i)) continue;
        if (faces(light_, dvec3(gbuffer_.position[i]), dvec3(gbuffer_.geometric_normal[i]))) {
          trace_pixel({x, y}, i, result);
        } else {
          result.visibility[i] = 0.0f;
        }
      }
    }
  }

  const TraceStatistics& statistics() const { return statistics_; }

 private:
  void trace_pixel(const ivec2& at, std::size_t i, TracedVisibility& result) {
    AdaptiveSampleCount sample_count(sampling_.params);
    AllWeightedSums sums{};
    do {
      const SampleRange& range = sample_count.next();
      const Randomisations before{range.split.count, range.begin};
      const std::uint32_t of_use = sample_count.is_pilot() ? pixel_pilot_purpose : pixel_purpose;
      for (int r = 0; r < range.split.count; ++r) {
        const std::uint32_t scramble =
            hash(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(r), sampling_.seed, of_use);
        for (int k = before.size(r); k < range.split.size(r); ++k) {
          trace_point(at, i, {scramble, static_cast<std::uint32_t>(k)}, sums[static_cast<std::size_t>(r)]);
        }
      }
      trace_packet();
      if (std::ranges::all_of(sums, [](const WeightedSums& s) { return s.all == 0.0; })) {
        trace_center(i, sums[0]);
      }
    } while (advance(sample_count, sums, sampling_.params));
    const PixelEstimate& estimate = sample_count.estimate();
    result.visibility[i] = static_cast<float>(estimate.value);
    result.variance[i] = static_cast<float>(estimate.variance);
    result.standard_error[i] = static_cast<float>(estimate.standard_error);
    result.samples[i] = static_cast<float>(estimate.rays);
  }

  struct Point {
    std::uint32_t scramble = 0;
    std::uint32_t index = 0;
  };

  void trace_point(const ivec2& at, std::size_t i, const Point& point, WeightedSums& sums) {
    const vec2 inside = sampling_.params.sampler == Sampler::owen ? owen_sobol(point.index, point.scramble)
                                                                  : random_point(point.index, point.scramble);
    const ivec2 fine = fine_pixels * at + ivec2(static_cast<float>(fine_pixels) * inside);
    const PrimaryHit hit = trace_primary(tracer_, fine_view_, pixel_ray(fine_view_, fine.x, fine.y));
    if (!is_same_surface(gbuffer_, i, hit)) return;
    surfel_.instance[0] = hit.instance;
    surfel_.triangle[0] = hit.triangle;
    surfel_.position[0] = vec3(hit.position);
    surfel_.geometric_normal[0] = vec3(hit.normal);
    shade(surfel_, 0, point, sums);
  }

  // By rounding, no point of the pixel sees the surface that its centre sees. Then the centre alone is traced.
  void trace_center(std::size_t i, WeightedSums& sums) {
    shade(gbuffer_, i, {0, 0}, sums);
    trace_packet();
  }

  // Adds a ray from the surfel to the light.
  void shade(const GBuffer& gbuffer, std::size_t i, const Point& point, WeightedSums& sums) {
    const RayOrigin origin = ray_origin(gbuffer, i, triangles_);
    statistics_.largest_offset = std::max(statistics_.largest_offset, origin.offset);
    double weight = 1.0;
    ShadowRay ray;
    bool is_facing = true;
    if (is_area(light_)) {
      const LightView view(light_, sampling_.params.light_sampling, dvec3(vec3(origin.point)));
      if (!view.is_inside()) {
        const LightView::Sample sample = view.sample(random_point(point.index, hash(point.scramble, light_purpose)));
        weight = sample.weight;
        ray.origin = vec3(origin.point);
        ray.direction = vec3(sample.direction);
        ray.reach = reach_to_light(sample.reach);
        ray.is_clear = is_clear(origin.normal, origin.clear_cosine, ray.direction);
        is_facing = glm::dot(dvec3(gbuffer.geometric_normal[i]), sample.direction) > 0.0;
      }
    } else {
      is_facing = to_center_.is_facing(gbuffer, i);
      ray = to_center_.ray_from(origin);
    }
    sums.all += weight;
    sums.squares += weight * weight;
    if (!is_facing) return;
    ++statistics_.rays;
    lanes_[packet_.size()] = {&sums, weight};
    packet_.add(ray, gbuffer.instance[i], gbuffer.triangle[i]);
    if (packet_.is_full()) trace_packet();
  }

  void trace_packet() {
    packet_.trace();
    for (std::size_t l = 0; l < packet_.size(); ++l) {
      if (!packet_.is_blocked(l)) lanes_[l].sums->lit += lanes_[l].weight;
    }
    packet_.clear();
  }

  // Where a ray of the packet is counted.
  struct Lane {
    WeightedSums* sums = nullptr;
    double weight = 1.0;
  };

  const Tracer& tracer_;
  const GBuffer& gbuffer_;
  View fine_view_;
  const Light& light_;
  const TruthSampling& sampling_;
  ShadowRayGenerator to_center_;
  OcclusionPacket packet_;
  std::array<Lane, packet_width> lanes_;
  TriangleCache triangles_;
  GBuffer surfel_{1, 1};
  TraceStatistics statistics_;
};

}  // namespace

TracedVisibility trace_pixel_visibility(const Tracer& tracer, const GBuffer& gbuffer, const View& view,
                                        const Light& light, const TruthSampling& sampling, const Progress& progress) {
  return trace_tiles(tracer, gbuffer, sampling.params, pixel_tile_size, progress,
                     [&] { return PixelTileTracer(tracer, gbuffer, view, light, sampling); });
}

}  // namespace umbrameter
