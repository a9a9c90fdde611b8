#include "raytrace/area_shadow.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <vector>

#include "core/quantiles.h"
#include "core/random.h"
#include "raytrace/area_light.h"
#include "raytrace/packet.h"
#include "raytrace/sampler.h"
#include "raytrace/surfel.h"

namespace umbrameter {
namespace {

constexpr int tile_size = 16;
// A packet is a block of 4 × 4 pixels; its lanes look at one light: coherent rays without more ado.
constexpr int block_size = 4;
static_assert(block_size * block_size == Packet::width);
// Keeps the points apart from those of other quantities at the same pixel.
constexpr std::uint32_t purpose = 0x11947u;

// Weighted points of one randomisation.
struct Sums {
  double lit = 0.0;
  double all = 0.0;
  double squares = 0.0;
};

struct Lane {
  std::size_t pixel = 0;
  vec3 origin{0};
  dvec3 normal{0.0};
  LightView view;
  vec2 slants{1.0f};
  std::vector<Sums> sums;  // of each randomisation
  bool is_traced = false;  // the point asked for is above the horizon
  double weight = 0.0;     // of that point
};

struct Share {
  double value = 0.0;
  double variance = 0.0;
  double unseen = 0.0;  // a share that the points may have missed with a probability of 5 %
};

// The ratio of the sums, and its variance from the scatter of the randomisations by the delta method (Cochran, Sampling
// Techniques, 1977, section 6.4); with weights of 1 it is that of a mean. One randomisation tells nothing of its
// scatter: then the largest that a value in [0, 1] can have. The rule of three is for even weights; uneven ones are
// worth as many as (Σ w)²/Σ w² of those (Kish, Survey Sampling, 1965, section 11.7).
Share share_of(const std::vector<Sums>& sums) {
  constexpr double rule_of_three = 2.995732273553991;  // −ln 0.05, see half_width_95()
  Sums total;
  for (const Sums& s : sums) {
    total.lit += s.lit;
    total.all += s.all;
    total.squares += s.squares;
  }
  if (!(total.all > 0.0)) return {};  // seen edge on: no part of it is visible
  Share share{total.lit / total.all, 0.25, std::min(rule_of_three * total.squares / (total.all * total.all), 1.0)};
  if (sums.size() < 2) return share;
  double squares = 0.0;
  for (const Sums& s : sums) squares += std::pow(s.lit - share.value * s.all, 2);
  const double n = static_cast<double>(sums.size());
  share.variance = squares * n / (n - 1.0) / (total.all * total.all);
  return share;
}

class BlockTracer {
 public:
  BlockTracer(const Tracer& tracer, const GBuffer& gbuffer, const Light& light, const TruthSampling& sampling)
      : tracer_(tracer),
        gbuffer_(gbuffer),
        light_(light),
        sampling_(sampling),
        split_(split(sampling.params.spp)),
        packet_(tracer.state()) {
    lanes_.reserve(Packet::width);
  }

  void trace(const Tile& block, TracedVisibility& result) {
    packet_.clear();
    lanes_.clear();
    for (int y = block.y_begin; y < block.y_end; ++y) {
      for (int x = block.x_begin; x < block.x_end; ++x) {
        const std::size_t i = gbuffer_.instance.index(x, y);
        if (gbuffer_.is_surface(i)) add(i, result);
      }
    }
    if (lanes_.empty()) return;
    for (int r = 0; r < split_.count; ++r) {
      for (int i = 0; i < split_.size(r); ++i)
        trace_point(static_cast<std::uint32_t>(r), static_cast<std::uint32_t>(i));
    }
    for (const Lane& lane : lanes_) {
      const Share share = share_of(lane.sums);
      result.visibility[lane.pixel] = static_cast<float>(share.value);
      result.variance[lane.pixel] = static_cast<float>(share.variance);
      result.standard_error[lane.pixel] =
          static_cast<float>(std::max(std::sqrt(share.variance), share.unseen / student_95(split_.count - 1.0)));
      result.samples[lane.pixel] = static_cast<float>(split_.points);
    }
  }

  const TraceStatistics& statistics() const { return statistics_; }

 private:
  void add(std::size_t i, TracedVisibility& result) {
    const RayOrigin origin = ray_origin(tracer_, gbuffer_, i);
    Lane lane{i,
              vec3(origin.point()),
              dvec3(gbuffer_.geometric_normal[i]),
              {light_, sampling_.params.light_sampling, dvec3(vec3(origin.point()))},
              vec2(0.5f) + vec2(to_unit_float(hash(static_cast<std::uint32_t>(i), 0u, sampling_.seed, purpose)),
                                to_unit_float(hash(static_cast<std::uint32_t>(i), 1u, sampling_.seed, purpose))),
              std::vector<Sums>(static_cast<std::size_t>(split_.count))};
    if (lane.view.is_within()) return;
    if (!(lane.view.facing(lane.normal) > 0.0)) {
      result.visibility[i] = 0.0f;
      return;
    }
    statistics_.largest_offset = std::max(statistics_.largest_offset, origin.offset);
    packet_.add({lane.origin, vec3(0, 0, 1), 0.0f}, gbuffer_.instance[i], gbuffer_.triangle[i]);
    lanes_.push_back(std::move(lane));
  }

  // One point of every lane. The surface itself hides what is below its horizon.
  void trace_point(std::uint32_t randomisation, std::uint32_t index) {
    for (int l = 0; l < packet_.size(); ++l) {
      Lane& lane = lanes_[static_cast<std::size_t>(l)];
      const std::uint32_t scramble =
          hash(static_cast<std::uint32_t>(lane.pixel), randomisation, sampling_.seed, purpose);
      const LightView::Sample sample = lane.view.sample(slanted(point_of(index, scramble), lane.slants));
      lane.is_traced = glm::dot(lane.normal, sample.direction) > 0.0;
      lane.weight = sample.weight;
      // The light is no blocker: the ray stops short of it by the rounding of its own length. Nothing is hit by a ray
      // without length.
      const float reach = lane.is_traced ? static_cast<float>(sample.reach * (1.0 - 0x1p-22)) : 0.0f;
      packet_.aim(l, {lane.origin, vec3(sample.direction), reach});
      statistics_.rays += lane.is_traced ? 1 : 0;
    }
    packet_.trace();
    for (int l = 0; l < packet_.size(); ++l) {
      Lane& lane = lanes_[static_cast<std::size_t>(l)];
      Sums& sums = lane.sums[randomisation];
      sums.all += lane.weight;
      sums.squares += lane.weight * lane.weight;
      if (lane.is_traced && !packet_.is_blocked(l)) sums.lit += lane.weight;
    }
  }

  vec2 point_of(std::uint32_t index, std::uint32_t scramble) const {
    return sampling_.params.sampler == Sampler::owen ? owen_sobol(index, scramble) : random_point(index, scramble);
  }

  const Tracer& tracer_;
  const GBuffer& gbuffer_;
  const Light& light_;
  const TruthSampling& sampling_;
  Randomisations split_;
  Packet packet_;
  std::vector<Lane> lanes_;
  TraceStatistics statistics_;
};

}  // namespace

TracedVisibility trace_area_visibility(const Tracer& tracer, const GBuffer& gbuffer, const Light& light,
                                       const TruthSampling& sampling, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const Image<float> none(gbuffer.width, gbuffer.height, 0.0f);
  TracedVisibility traced{
      Image<float>(gbuffer.width, gbuffer.height, 1.0f), {}, none, none, none, split(sampling.params.spp).count - 1};
  std::mutex mutex;
  parallel_tiles(
      gbuffer.width, gbuffer.height, tile_size,
      [&](const Tile& tile) {
        BlockTracer tracing(tracer, gbuffer, light, sampling);
        for (int y = tile.y_begin; y < tile.y_end; y += block_size) {
          for (int x = tile.x_begin; x < tile.x_end; x += block_size) {
            tracing.trace({x, y, std::min(x + block_size, tile.x_end), std::min(y + block_size, tile.y_end)}, traced);
          }
        }
        const std::lock_guard lock(mutex);
        traced.statistics.rays += tracing.statistics().rays;
        traced.statistics.largest_offset =
            std::max(traced.statistics.largest_offset, tracing.statistics().largest_offset);
      },
      progress);
  traced.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return traced;
}

}  // namespace umbrameter
