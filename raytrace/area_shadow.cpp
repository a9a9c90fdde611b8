#include "raytrace/area_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "core/random.h"
#include "raytrace/area_light.h"
#include "raytrace/packet.h"
#include "raytrace/sampler.h"
#include "raytrace/surfel.h"
#include "raytrace/visibility_tiles.h"
#include "raytrace/weighted_points.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

constexpr int area_tile_size = 16;
// A packet holds one ray from each pixel of a block.
constexpr int block_size = 4;
static_assert(std::size_t{block_size} * block_size == packet_width);
// Make the random numbers independent of those for other quantities at the same pixel.
constexpr std::uint32_t area_purpose = 0x11947u;
constexpr std::uint32_t area_pilot_purpose = 0x21947u;
constexpr std::uint32_t shear_purpose = 0x31947u;

struct Pixel {
  std::size_t index = 0;
  vec3 origin{0};
  dvec3 normal{0.0};           // of the surfel
  dvec3 triangle_normal{0.0};  // RayOrigin::normal
  double clear_cosine = 2.0;
  LightView view;
  vec2 shear_factors{1.0f};
  AdaptiveSampleCount sample_count;
  AllWeightedSums sums{};
};

class AreaTileTracer {
 public:
  AreaTileTracer(const Tracer& tracer, const GBuffer& gbuffer, const Light& light, const TruthSampling& sampling)
      : gbuffer_(gbuffer), light_(light), sampling_(sampling), packet_(tracer.state()), triangles_(tracer) {}

  void trace(const Tile& tile, TracedVisibility& result) {
    for (int y = tile.y_begin; y < tile.y_end; y += block_size) {
      for (int x = tile.x_begin; x < tile.x_end; x += block_size) {
        for (int v = y; v < std::min(y + block_size, tile.y_end); ++v) {
          for (int u = x; u < std::min(x + block_size, tile.x_end); ++u) {
            const std::size_t i = gbuffer_.instance.index(u, v);
            if (gbuffer_.is_surface(i)) add(i, result);
          }
        }
      }
    }
    // Pixels that need the same range of points share packets. A pixel's result depends on its own rays only.
    while (!pending_.empty()) {
      const auto work = [this](int i) {
        const AdaptiveSampleCount& s = pixels_[static_cast<std::size_t>(i)].sample_count;
        return std::tuple(s.is_pilot(), s.next().begin, s.next().split.points);
      };
      std::ranges::stable_sort(pending_, [&](int a, int b) { return work(a) < work(b); });
      for (std::size_t first = 0; first < pending_.size();) {
        std::size_t last = first;
        while (last < pending_.size() && last - first < packet_width && work(pending_[last]) == work(pending_[first])) {
          ++last;
        }
        trace_packet(first, last);
        first = last;
      }
      std::erase_if(pending_, [&](int i) {
        Pixel& pixel = pixels_[static_cast<std::size_t>(i)];
        return !advance(pixel.sample_count, pixel.sums, sampling_.params);
      });
    }
    for (const Pixel& pixel : pixels_) store(pixel, result);
  }

  const TraceStatistics& statistics() const { return statistics_; }

 private:
  void add(std::size_t i, TracedVisibility& result) {
    const RayOrigin origin = ray_origin(gbuffer_, i, triangles_);
    const auto random_factor = [&](std::uint32_t axis) {
      return 0.5f + to_unit_float(hash(static_cast<std::uint32_t>(i), axis, sampling_.seed, shear_purpose));
    };
    Pixel pixel{i,
                vec3(origin.point),
                dvec3(gbuffer_.geometric_normal[i]),
                origin.normal,
                origin.clear_cosine,
                {light_, sampling_.params.light_sampling, dvec3(vec3(origin.point))},
                {random_factor(0u), random_factor(1u)},
                AdaptiveSampleCount(sampling_.params)};
    if (pixel.view.is_inside()) return;
    if (!faces(light_, dvec3(gbuffer_.position[i]), pixel.normal)) {
      result.visibility[i] = 0.0f;
      return;
    }
    statistics_.largest_offset = std::max(statistics_.largest_offset, origin.offset);
    pending_.push_back(static_cast<int>(pixels_.size()));
    pixels_.push_back(pixel);
  }

  Pixel& pending(std::size_t i) { return pixels_[static_cast<std::size_t>(pending_[i])]; }

  void trace_packet(std::size_t first, std::size_t last) {
    packet_.clear();
    for (std::size_t i = first; i < last; ++i) {
      const Pixel& pixel = pending(i);
      packet_.add({pixel.origin, vec3(0, 0, 1), 0.0f, true}, gbuffer_.instance[pixel.index],
                  gbuffer_.triangle[pixel.index]);
    }
    const SampleRange range = pending(first).sample_count.next();
    const Randomisations before{range.split.count, range.begin};
    for (int r = 0; r < range.split.count; ++r) {
      for (int i = before.size(r); i < range.split.size(r); ++i) {
        trace_point(first, static_cast<std::uint32_t>(r), static_cast<std::uint32_t>(i));
      }
    }
  }

  // Traces one point for each pixel of the packet. Points below the surfel's plane are hidden and need no ray.
  void trace_point(std::size_t first, std::uint32_t randomisation, std::uint32_t index) {
    std::array<double, packet_width> weights{};
    std::array<bool, packet_width> is_traced{};
    for (std::size_t l = 0; l < packet_.size(); ++l) {
      const Pixel& pixel = pending(first + l);
      const std::uint32_t scramble = hash(static_cast<std::uint32_t>(pixel.index), randomisation, sampling_.seed,
                                          pixel.sample_count.is_pilot() ? area_pilot_purpose : area_purpose);
      const LightView::Sample sample = pixel.view.sample(shear(point_of(index, scramble), pixel.shear_factors));
      const bool is_above = glm::dot(pixel.normal, sample.direction) > 0.0;
      is_traced[l] = is_above;
      weights[l] = sample.weight;
      const vec3 direction(sample.direction);
      // A ray of zero length hits nothing.
      packet_.aim(l, {pixel.origin, direction, is_above ? reach_to_light(sample.reach) : 0.0f,
                      !is_above || is_clear(pixel.triangle_normal, pixel.clear_cosine, direction)});
      statistics_.rays += is_above ? 1u : 0u;
    }
    packet_.trace();
    for (std::size_t l = 0; l < packet_.size(); ++l) {
      WeightedSums& sums = pending(first + l).sums[randomisation];
      const double weight = weights[l];
      sums.all += weight;
      sums.squares += weight * weight;
      if (is_traced[l] && !packet_.is_blocked(l)) sums.lit += weight;
    }
  }

  vec2 point_of(std::uint32_t index, std::uint32_t scramble) const {
    return sampling_.params.sampler == Sampler::owen ? owen_sobol(index, scramble) : random_point(index, scramble);
  }

  void store(const Pixel& pixel, TracedVisibility& result) const {
    const PixelEstimate& estimate = pixel.sample_count.estimate();
    result.visibility[pixel.index] = static_cast<float>(estimate.value);
    result.variance[pixel.index] = static_cast<float>(estimate.variance);
    result.standard_error[pixel.index] = static_cast<float>(estimate.standard_error);
    result.samples[pixel.index] = static_cast<float>(estimate.rays);
  }

  const GBuffer& gbuffer_;
  const Light& light_;
  const TruthSampling& sampling_;
  OcclusionPacket packet_;
  TriangleCache triangles_;
  std::vector<Pixel> pixels_;
  std::vector<int> pending_;
  TraceStatistics statistics_;
};

}  // namespace

TracedVisibility trace_area_visibility(const Tracer& tracer, const GBuffer& gbuffer, const Light& light,
                                       const TruthSampling& sampling, const Progress& progress) {
  return trace_tiles(tracer, gbuffer, sampling.params, area_tile_size, progress,
                     [&] { return AreaTileTracer(tracer, gbuffer, light, sampling); });
}

}  // namespace umbrameter
