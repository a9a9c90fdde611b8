#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

#include "core/random.h"
#include "raytrace/packet.h"
#include "raytrace/sampler.h"
#include "raytrace/surfel.h"

namespace umbrameter {
namespace {

constexpr int tile_size = 16;
// A packet is a block of 4 × 4 pixels, and its lanes look into the same part of the hemisphere: coherent rays.
constexpr int block_size = 4;
static_assert(block_size * block_size == Packet::width);
// Parts of the square in each direction by which a pixel's points are put in order.
constexpr std::uint32_t strata = 16;

struct Sample {
  vec2 point;
  std::uint16_t randomisation = 0;
  std::uint16_t stratum = 0;
};

// Strata row by row, back and forth, so that neighbours follow one another.
std::uint16_t stratum_of(vec2 point) {
  const auto row = static_cast<std::uint32_t>(point.x * strata);
  const auto column = static_cast<std::uint32_t>(point.y * strata);
  return static_cast<std::uint16_t>(row * strata + (row % 2 == 0 ? column : strata - 1 - column));
}

// All of a pixel's points, ordered by stratum (a counting sort), so that equal ranks of neighbouring pixels look in
// about the same direction. Which points there are does not depend on the order.
class PixelSamples {
 public:
  void make(const Randomisations& split, std::uint32_t pixel, std::uint32_t seed) {
    unsorted_.clear();
    std::array<int, strata * strata + 1> first{};
    for (int r = 0; r < split.count; ++r) {
      const std::uint32_t scramble = hash(pixel, static_cast<std::uint32_t>(r), seed);
      for (int i = 0; i < split.size(r); ++i) {
        const vec2 point = owen_sobol(static_cast<std::uint32_t>(i), scramble);
        unsorted_.push_back({point, static_cast<std::uint16_t>(r), stratum_of(point)});
        ++first[unsorted_.back().stratum + 1u];
      }
    }
    for (std::size_t s = 1; s < first.size(); ++s) first[s] += first[s - 1];
    sorted_.resize(unsorted_.size());
    for (const Sample& sample : unsorted_) sorted_[static_cast<std::size_t>(first[sample.stratum]++)] = sample;
  }
  const Sample& operator[](std::size_t rank) const { return sorted_[rank]; }

 private:
  std::vector<Sample> unsorted_;
  std::vector<Sample> sorted_;
};

struct Lane {
  std::size_t pixel = 0;
  vec3 origin{0};
  mat3 frame{1.0f};
  double offset = 0.0;
  float clear_height = 0;  // over the surface, of a direction that cannot meet the own triangle
  std::vector<int> open;   // of each randomisation's rays
  PixelSamples samples;
};

// A hit counts up to ao_distance from the surface point; the ray starts `offset` above it, which shortens its way by
// offset · cos θ to first order.
float reach_of(const TruthParams& params, double offset, float cosine) {
  if (params.ao_distance <= 0.0) return std::numeric_limits<float>::infinity();
  return static_cast<float>(std::max(params.ao_distance - offset * static_cast<double>(cosine), 0.0));
}

// Standard error of the pixel from the scatter of its randomisations' means. One randomisation tells nothing of its
// scatter: then the largest that a mean of values in [0, 1] can have.
float standard_error(const std::vector<int>& open, const Randomisations& split) {
  if (split.count < 2) return 0.5f;
  double sum = 0.0;
  double squares = 0.0;
  for (int r = 0; r < split.count; ++r) {
    const double mean = static_cast<double>(open[static_cast<std::size_t>(r)]) / split.size(r);
    sum += mean;
    squares += mean * mean;
  }
  const double n = split.count;
  const double variance = std::max(squares - sum * sum / n, 0.0) / (n - 1.0);
  return static_cast<float>(std::sqrt(variance / n));
}

class BlockTracer {
 public:
  BlockTracer(const Tracer& tracer, const GBuffer& gbuffer, const TruthParams& params, std::uint32_t seed)
      : tracer_(tracer),
        gbuffer_(gbuffer),
        params_(params),
        seed_(seed),
        split_(split(params.spp)),
        packet_(tracer.state()),
        lanes_(Packet::width) {}

  void trace(int x_begin, int y_begin, int x_end, int y_end, TracedAo& result) {
    packet_.clear();
    for (int y = y_begin; y < y_end; ++y) {
      for (int x = x_begin; x < x_end; ++x) {
        const std::size_t i = gbuffer_.instance.index(x, y);
        if (gbuffer_.is_surface(i)) add(i);
      }
    }
    if (packet_.size() == 0) return;
    for (int rank = 0; rank < params_.spp; ++rank) trace_rank(static_cast<std::size_t>(rank));
    for (int lane = 0; lane < packet_.size(); ++lane) {
      const Lane& l = lanes_[static_cast<std::size_t>(lane)];
      int open = 0;
      for (const int count : l.open) open += count;
      result.ao[l.pixel] = static_cast<float>(static_cast<double>(open) / params_.spp);
      result.standard_error[l.pixel] = standard_error(l.open, split_);
    }
    statistics_.rays += static_cast<std::uint64_t>(packet_.size()) * static_cast<std::uint64_t>(params_.spp);
  }

  const TraceStatistics& statistics() const { return statistics_; }

 private:
  void add(std::size_t i) {
    Lane& lane = lanes_[static_cast<std::size_t>(packet_.size())];
    const RayOrigin origin = ray_origin(tracer_, gbuffer_, i);
    lane.pixel = i;
    lane.origin = vec3(origin.point());
    lane.frame = frame_about(vec3(origin.normal));
    lane.offset = origin.offset;
    // The frame and its product are rounded a few times.
    lane.clear_height = static_cast<float>(origin.clear_cosine) + 0x1p-20f;
    lane.open.assign(static_cast<std::size_t>(split_.count), 0);
    lane.samples.make(split_, static_cast<std::uint32_t>(i), seed_);
    statistics_.largest_offset = std::max(statistics_.largest_offset, origin.offset);
    packet_.add({lane.origin, vec3(0), 0.0f, true}, gbuffer_.instance[i], gbuffer_.triangle[i]);
  }

  void trace_rank(std::size_t rank) {
    for (int i = 0; i < packet_.size(); ++i) {
      const Lane& lane = lanes_[static_cast<std::size_t>(i)];
      const vec2 point = lane.samples[rank].point;
      const vec3 local = params_.ao_weight == AoWeight::cosine ? cosine_hemisphere(point) : uniform_hemisphere(point);
      packet_.aim(
          i, {lane.origin, lane.frame * local, reach_of(params_, lane.offset, local.z), local.z > lane.clear_height});
    }
    packet_.trace();
    for (int i = 0; i < packet_.size(); ++i) {
      Lane& lane = lanes_[static_cast<std::size_t>(i)];
      if (!packet_.is_blocked(i)) ++lane.open[lane.samples[rank].randomisation];
    }
  }

  const Tracer& tracer_;
  const GBuffer& gbuffer_;
  const TruthParams& params_;
  std::uint32_t seed_;
  Randomisations split_;
  Packet packet_;
  std::vector<Lane> lanes_;
  TraceStatistics statistics_;
};

}  // namespace

TracedAo trace_ao(const Tracer& tracer, const GBuffer& gbuffer, const TruthParams& params, std::uint32_t seed,
                  const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  TracedAo traced{
      Image<float>(gbuffer.width, gbuffer.height, 1.0f), Image<float>(gbuffer.width, gbuffer.height, 0.0f), {}};
  std::mutex mutex;
  parallel_tiles(
      gbuffer.width, gbuffer.height, tile_size,
      [&](const Tile& tile) {
        BlockTracer block(tracer, gbuffer, params, seed);
        for (int y = tile.y_begin; y < tile.y_end; y += block_size) {
          for (int x = tile.x_begin; x < tile.x_end; x += block_size) {
            block.trace(x, y, std::min(x + block_size, tile.x_end), std::min(y + block_size, tile.y_end), traced);
          }
        }
        const std::lock_guard lock(mutex);
        traced.statistics.rays += block.statistics().rays;
        traced.statistics.largest_offset =
            std::max(traced.statistics.largest_offset, block.statistics().largest_offset);
      },
      progress);
  traced.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return traced;
}

}  // namespace umbrameter
