// Traces ambient occlusion of one tile of pixels. For raytrace/ambient_occlusion.cpp alone.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"
#include "raytrace/ao_estimate.h"
#include "raytrace/ao_samples.h"
#include "raytrace/hit_packet.h"
#include "raytrace/stopping.h"
#include "raytrace/surfel.h"

namespace umbrameter {

/// What every tile of one image has in common.
struct AoTask {
  const Tracer& tracer;
  const GBuffer& gbuffer;
  const TruthParams& params;
  std::uint32_t seed = 0;
};

/// Rays is Packet, or HitPacket where distances are wanted. A packet holds pixels that need the same range of points:
/// blocks of 4 × 4 while all do, near ones later. Each pixel's answer depends on its own rays alone.
template <class Rays>
class AoTile {
 public:
  explicit AoTile(const AoTask& task) : task_(task), reach_(reach_of(task.params)), packet_(task.tracer.state()) {}

  void trace(const Tile& tile, TracedAo& result) {
    collect(tile);
    while (!pending_.empty()) {
      const auto work = [this](int i) {
        const Pixel& p = pixels_[static_cast<std::size_t>(i)];
        return std::tuple(p.stopping.is_pilot(), p.stopping.next().begin, p.stopping.next().split.points);
      };
      std::stable_sort(pending_.begin(), pending_.end(), [&](int a, int b) { return work(a) < work(b); });
      for (std::size_t first = 0; first < pending_.size();) {
        std::size_t last = first;
        while (last < pending_.size() && last - first < static_cast<std::size_t>(Rays::width) &&
               work(pending_[last]) == work(pending_[first])) {
          ++last;
        }
        trace_packet(first, last);
        first = last;
      }
      std::erase_if(pending_, [&](int i) { return !advance(pixels_[static_cast<std::size_t>(i)]); });
    }
    for (const Pixel& pixel : pixels_) store(pixel, result);
  }

  const TraceStatistics& statistics() const { return statistics_; }

 private:
  static constexpr bool knows_distance = std::is_same_v<Rays, HitPacket>;
  static constexpr int block_size = 4;
  static_assert(block_size * block_size == Rays::width);

  struct Pixel {
    explicit Pixel(const TruthParams& params) : stopping(params) {}
    std::size_t index = 0;
    vec3 origin{0};
    vec3 normal{0, 0, 1};  // of the triangle
    mat3 frame{1.0f};
    double offset = 0.0;
    float clear_cosine = 0;  // with the triangle's normal, of a direction that cannot meet it
    Stopping stopping;
    AoEstimate estimate;
    dvec3 open_direction{0.0};
    double blocked = 0.0;
    double blocked_distance = 0.0;
  };

  struct Lanes {
    std::array<float, Rays::width> offset{};
    std::array<float, Rays::width> clear_cosine{};
  };

  void collect(const Tile& tile) {
    pixels_.clear();
    pending_.clear();
    for (int y = tile.y_begin; y < tile.y_end; y += block_size) {
      for (int x = tile.x_begin; x < tile.x_end; x += block_size) {
        for (int v = y; v < std::min(y + block_size, tile.y_end); ++v) {
          for (int u = x; u < std::min(x + block_size, tile.x_end); ++u) {
            const std::size_t i = task_.gbuffer.instance.index(u, v);
            if (task_.gbuffer.is_surface(i)) add(i);
          }
        }
      }
    }
  }

  void add(std::size_t i) {
    const RayOrigin origin = ray_origin(task_.tracer, task_.gbuffer, i, last_);
    Pixel pixel(task_.params);
    pixel.index = i;
    pixel.origin = vec3(origin.point());
    pixel.normal = vec3(origin.normal);
    const vec3 shading = task_.gbuffer.shading_normal[i];
    const bool is_turned = task_.params.ao_normal == AoNormal::shading && glm::dot(shading, shading) > 0.0f;
    pixel.frame = frame_about(is_turned ? glm::normalize(shading) : pixel.normal);
    pixel.offset = origin.offset;
    // The frame and its product are rounded a few times.
    pixel.clear_cosine = static_cast<float>(origin.clear_cosine) + 0x1p-20f;
    statistics_.largest_offset = std::max(statistics_.largest_offset, origin.offset);
    pending_.push_back(static_cast<int>(pixels_.size()));
    pixels_.push_back(pixel);
  }

  void trace_packet(std::size_t first, std::size_t last) {
    packet_.clear();
    lanes_ = {};
    for (std::size_t i = first; i < last; ++i) {
      Pixel& pixel = pixels_[static_cast<std::size_t>(pending_[i])];
      packet_.add({pixel.origin, vec3(0), 0.0f, true}, task_.gbuffer.instance[pixel.index],
                  task_.gbuffer.triangle[pixel.index]);
      lanes_.offset[i - first] = static_cast<float>(pixel.offset);
      lanes_.clear_cosine[i - first] = pixel.clear_cosine;
      const std::uint32_t stream =
          hash(static_cast<std::uint32_t>(pixel.index), pixel.stopping.is_pilot() ? 1u : 0u, task_.seed);
      samples_.make(task_.params, static_cast<int>(i - first),
                    {pixel.stopping.next(), pixel.frame, pixel.normal, stream});
    }
    const int ranks = pixels_[static_cast<std::size_t>(pending_[first])].stopping.next().size();
    for (int rank = 0; rank < ranks; ++rank) trace_rank(first, static_cast<std::size_t>(rank));
    for (std::size_t i = first; i < last; ++i) {
      Pixel& pixel = pixels_[static_cast<std::size_t>(pending_[i])];
      pixel.estimate.split = pixel.stopping.next().split;
    }
    statistics_.rays += static_cast<std::uint64_t>(last - first) * static_cast<std::uint64_t>(ranks);
  }

  void trace_rank(std::size_t first, std::size_t rank) {
    const int size = packet_.size();
    const SampleRank& samples = samples_[rank];
    // A hit counts up to ao_distance from the surface point: the ray starts above it, which shortens its way by
    // offset · cosine to first order.
    std::array<float, Rays::width> steps;
    std::array<float, Rays::width> reaches;
    bool is_clear = true;
    for (std::size_t l = 0; l < steps.size(); ++l) {
      const float cosine = samples.cosine[l];
      steps[l] = lanes_.offset[l] * cosine;
      const auto reach = static_cast<float>(std::max(reach_ - static_cast<double>(steps[l]), 0.0));
      reaches[l] = cosine > 0.0f ? reach : -1.0f;
      is_clear &= cosine <= 0.0f || cosine > lanes_.clear_cosine[l];
    }
    packet_.aim(samples.directions, reaches.data(), is_clear);
    packet_.trace();
    for (int lane = 0; lane < size; ++lane) {
      const auto l = static_cast<std::size_t>(lane);
      Pixel& pixel = pixels_[static_cast<std::size_t>(pending_[first + l])];
      double open = 1.0;
      if (packet_.is_blocked(lane)) {
        open = 0.0;
        if constexpr (knows_distance) {
          const double distance = static_cast<double>(packet_.distance(lane)) + static_cast<double>(steps[l]);
          open = 1.0 - falloff_weight(task_.params.ao_falloff, std::max(distance, 0.0), task_.params.ao_distance);
          pixel.blocked += 1.0;
          pixel.blocked_distance += std::max(distance, 0.0);
        }
      }
      pixel.estimate.open[samples.randomisation[l]] += open;
      if constexpr (knows_distance)
        pixel.open_direction += open * dvec3(samples.directions.x[l], samples.directions.y[l], samples.directions.z[l]);
    }
  }

  // Whether the pixel needs more rays.
  bool advance(Pixel& pixel) const {
    const bool was_pilot = pixel.stopping.is_pilot();
    const bool goes_on = pixel.stopping.advance(task_.params, pixel.estimate);
    if (was_pilot) {
      pixel.estimate = {};
      pixel.open_direction = dvec3(0.0);
      pixel.blocked = pixel.blocked_distance = 0.0;
    }
    return goes_on;
  }

  void store(const Pixel& pixel, TracedAo& result) const {
    const PixelEstimate& estimate = pixel.stopping.estimate();
    result.ao[pixel.index] = static_cast<float>(estimate.value);
    result.standard_error[pixel.index] = static_cast<float>(estimate.standard_error);
    result.variance[pixel.index] = static_cast<float>(estimate.variance);
    result.samples[pixel.index] = static_cast<float>(estimate.rays);
    if (result.bent_normal.size() > 0) {
      const double length = glm::length(pixel.open_direction);
      result.bent_normal[pixel.index] = length > 0.0 ? vec3(pixel.open_direction / length) : vec3(0);
    }
    if (result.hit_distance.size() > 0) {
      result.hit_distance[pixel.index] = pixel.blocked > 0.0
                                             ? static_cast<float>(pixel.blocked_distance / pixel.blocked)
                                             : std::numeric_limits<float>::infinity();
    }
  }

  const AoTask& task_;
  double reach_;
  Rays packet_;
  Lanes lanes_;
  SurfelTriangle last_;
  PacketSamples samples_;
  std::vector<Pixel> pixels_;
  std::vector<int> pending_;
  TraceStatistics statistics_;
};

}  // namespace umbrameter
