// Traces ambient occlusion of one tile of pixels. For raytrace/ambient_occlusion.cpp alone.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "core/parallel.h"
#include "core/random.h"
#include "raytrace/ao_estimate.h"
#include "raytrace/ao_samples.h"
#include "raytrace/packet_width.h"
#include "raytrace/stopping.h"
#include "raytrace/surfel.h"

namespace umbrameter {

/// Rays is OcclusionPacket, or HitPacket where distances are wanted. A packet holds rays of one pixel: they leave from
/// one place, and next to one another in PixelSamples' order they meet about the same boxes.
template <class Rays>
class AoTile {
 public:
  explicit AoTile(const AoTask& task)
      : task_(task), reach_(reach_of(task.params)), packet_(task.tracer.state()), triangles_(task.tracer) {}

  void trace(const Tile& tile, TracedAo& result) {
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
      for (int x = tile.x_begin; x < tile.x_end; ++x) {
        const std::size_t i = task_.gbuffer.instance.index(x, y);
        if (!task_.gbuffer.is_surface(i)) continue;
        Pixel pixel = start(i);
        do {
          trace_range(pixel);
        } while (advance(pixel));
        store(pixel, result);
      }
    }
  }

  const TraceStatistics& statistics() const { return statistics_; }

 private:
  struct Pixel {
    explicit Pixel(const TruthParams& params) : stopping(params) {}
    std::size_t index = 0;
    PixelDirections directions;
    float clear_cosine = 0;  // with the triangle's normal, of a direction that cannot meet it
    Stopping stopping;
    AoEstimate estimate;
    dvec3 open_direction{0.0};
    double blocked = 0.0;
    double blocked_distance = 0.0;
  };

  Pixel start(std::size_t i) {
    const RayOrigin origin = ray_origin(task_.gbuffer, i, triangles_);
    packet_.clear();
    for (int lane = 0; lane < Rays::width; ++lane) {
      packet_.add({vec3(origin.point), vec3(0, 0, 1), 0.0f, true}, task_.gbuffer.instance[i],
                  task_.gbuffer.triangle[i]);
    }
    Pixel pixel(task_.params);
    pixel.index = i;
    PixelDirections& directions = pixel.directions;
    directions.normal = vec3(origin.normal);
    const vec3 shading = task_.gbuffer.shading_normal[i];
    const bool is_turned = task_.params.ao_normal == AoNormal::shading && glm::dot(shading, shading) > 0.0f;
    directions.frame = frame_about(is_turned ? glm::normalize(shading) : directions.normal);
    directions.offset = origin.offset;
    directions.reach = reach_;
    // The frame and its product are rounded a few times.
    pixel.clear_cosine = static_cast<float>(origin.clear_cosine) + 0x1p-20f;
    statistics_.largest_offset = std::max(statistics_.largest_offset, origin.offset);
    return pixel;
  }

  void trace_range(Pixel& pixel) {
    pixel.directions.range = pixel.stopping.next();
    pixel.directions.stream =
        hash(static_cast<std::uint32_t>(pixel.index), pixel.stopping.is_pilot() ? 1u : 0u, task_.seed);
    samples_.make(task_.params, pixel.directions);
    const std::size_t size = samples_.size();
    std::array<std::uint32_t, most_randomisations> open{};
    for (std::size_t first = 0; first < size; first += Rays::width) {
      const int count = static_cast<int>(std::min(size - first, static_cast<std::size_t>(Rays::width)));
      packet_.aim({samples_.x.data() + first, samples_.y.data() + first, samples_.z.data() + first,
                   samples_.reach.data() + first, count, are_clear(first, pixel.clear_cosine)});
      packet_.trace();
      for (int lane = 0; lane < count; ++lane) {
        const std::size_t ray = first + static_cast<std::size_t>(lane);
        if constexpr (Rays::knows_distance) {
          weigh(pixel, ray, lane);
        } else {
          open[samples_.randomisation[ray]] += packet_.is_blocked(lane) ? 0u : 1u;
        }
      }
    }
    pixel.estimate.split = pixel.directions.range.split;
    for (std::size_t r = 0; r < open.size(); ++r) pixel.estimate.open[r] += open[r];
    statistics_.rays += size;
  }

  bool are_clear(std::size_t first, float clear_cosine) const {
    const float* const cosine = samples_.cosine.data() + first;
    bool are_clear = true;
    for (int lane = 0; lane < Rays::width; ++lane) are_clear &= cosine[lane] <= 0.0f || cosine[lane] > clear_cosine;
    return are_clear;
  }

  void weigh(Pixel& pixel, std::size_t ray, int lane) {
    double open = 1.0;
    if (packet_.is_blocked(lane)) {
      const double distance =
          std::max(static_cast<double>(packet_.distance(lane)) + static_cast<double>(samples_.step[ray]), 0.0);
      open = 1.0 - falloff_weight(task_.params.ao_falloff, distance, task_.params.ao_distance);
      pixel.blocked += 1.0;
      pixel.blocked_distance += distance;
    }
    pixel.estimate.open[samples_.randomisation[ray]] += open;
    pixel.open_direction += open * dvec3(samples_.x[ray], samples_.y[ray], samples_.z[ray]);
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
  SurfelTable triangles_;
  PixelSamples samples_;
  TraceStatistics statistics_;
};

}  // namespace umbrameter
