// Traces ambient occlusion of one tile of pixels. For raytrace/ambient_occlusion.cpp alone.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"
#include "raytrace/adaptive_sampling.h"
#include "raytrace/ao_samples.h"
#include "raytrace/packet.h"
#include "raytrace/randomized_estimate.h"
#include "raytrace/surfel.h"

namespace umbrameter {

/// The inputs of all tiles of an image.
struct AoTask {
  const Tracer& tracer;
  const GBuffer& gbuffer;
  const TruthParams& params;
  std::uint32_t seed = 0;
};

/// Rays is OcclusionPacket, or HitPacket if distances are needed. A packet holds rays of similar direction from
/// neighbouring pixels of one triangle.
template <class Rays>
class AoTile {
 public:
  explicit AoTile(const AoTask& task)
      : task_(task), reach_(reach_of(task.params)), packet_(task.tracer.state()), triangles_(task.tracer) {}

  void trace(const Tile& tile, TracedAo& result) {
    for (int y = tile.y_begin; y < tile.y_end; y += block_size) {
      for (int x = tile.x_begin; x < tile.x_end; x += block_size) {
        trace_block({x, y, std::min(x + block_size, tile.x_end), std::min(y + block_size, tile.y_end)}, result);
      }
    }
  }

  const TraceStatistics& statistics() const { return statistics_; }

 private:
  static constexpr int block_size = 8;
  static_assert(block_size * block_size <= HemisphereSamples::max_pixels);
  // About a third of a megabyte, so that they fit into the L2 cache (docs/decisions/packets-of-neighbours.md).
  static constexpr int max_rays_together = 16384;

  struct Pixel {
    explicit Pixel(const TruthParams& params) : sample_count(params) {}
    std::size_t index = 0;
    vec3 origin{0};
    Hemisphere hemisphere;
    AdaptiveSampleCount sample_count;
    RandomizedEstimate estimate;
    dvec3 open_direction{0.0};
    double blocked = 0.0;
    double blocked_distance = 0.0;
    bool needs_more = true;
  };

  void trace_block(const Tile& block, TracedAo& result) {
    pixels_.clear();
    for (int y = block.y_begin; y < block.y_end; ++y) {
      for (int x = block.x_begin; x < block.x_end; ++x) {
        const std::size_t i = task_.gbuffer.instance.index(x, y);
        if (task_.gbuffer.is_surface(i)) pixels_.push_back(start(i));
      }
    }
    for (std::size_t first = 0; first < pixels_.size();) {
      const std::span<Pixel> left = std::span(pixels_).subspan(first);
      const auto others = std::partition(left.begin() + 1, left.end(),
                                         [&](const Pixel& pixel) { return may_share(left.front(), pixel); });
      const auto size = static_cast<std::size_t>(others - left.begin());
      trace_group(left.first(size));
      first += size;
    }
    for (const Pixel& pixel : pixels_) store(pixel, result);
  }

  Pixel start(std::size_t i) {
    const RayOrigin origin = ray_origin(task_.gbuffer, i, triangles_);
    Pixel pixel(task_.params);
    pixel.index = i;
    pixel.origin = vec3(origin.point);
    Hemisphere& hemisphere = pixel.hemisphere;
    hemisphere.normal = vec3(origin.normal);
    const vec3 shading = task_.gbuffer.shading_normal[i];
    const bool uses_shading_normal = task_.params.ao_normal == AoNormal::shading && glm::dot(shading, shading) > 0.0f;
    hemisphere.frame = frame_about(uses_shading_normal ? glm::normalize(shading) : hemisphere.normal);
    hemisphere.offset = origin.offset;
    hemisphere.reach = reach_;
    // The margin covers the rounding of the frame and of its product with the direction.
    hemisphere.clear_cosine = static_cast<float>(origin.clear_cosine) + 0x1p-20f;
    statistics_.largest_offset = std::max(statistics_.largest_offset, origin.offset);
    return pixel;
  }

  // Whether the rays of two pixels may be sorted together. Not if distances are summed, because sums of floating-point
  // numbers depend on their order, which then must not depend on other pixels.
  bool may_share(const Pixel& a, const Pixel& b) const {
    const GBuffer& gbuffer = task_.gbuffer;
    return !Rays::finds_nearest && gbuffer.instance[a.index] == gbuffer.instance[b.index] &&
           gbuffer.triangle[a.index] == gbuffer.triangle[b.index] && a.hemisphere == b.hemisphere;
  }

  // Traces pixels that share a triangle and a hemisphere.
  void trace_group(std::span<Pixel> pixels) {
    const std::size_t first = pixels.front().index;
    packet_.set_own_triangle(task_.gbuffer.instance[first], task_.gbuffer.triangle[first]);
    while (!pixels.empty()) {
      for (std::span<Pixel> left = pixels; !left.empty();) {
        std::size_t size = 1;
        int rays = left.front().sample_count.next().size();
        for (; size < left.size() && rays + left[size].sample_count.next().size() <= max_rays_together; ++size) {
          rays += left[size].sample_count.next().size();
        }
        trace_together(left.first(size));
        left = left.subspan(size);
      }
      for (Pixel& pixel : pixels) pixel.needs_more = advance(pixel);
      const auto done =
          std::partition(pixels.begin(), pixels.end(), [](const Pixel& pixel) { return pixel.needs_more; });
      pixels = {pixels.begin(), done};
    }
  }

  void trace_together(std::span<Pixel> pixels) {
    pixel_rays_.clear();
    for (const Pixel& pixel : pixels) {
      const std::uint32_t stream =
          hash(static_cast<std::uint32_t>(pixel.index), pixel.sample_count.is_pilot() ? 1u : 0u, task_.seed);
      pixel_rays_.push_back({pixel.origin, pixel.sample_count.next(), stream});
    }
    samples_.make(task_.params, pixels.front().hemisphere, pixel_rays_);
    const std::size_t size = samples_.size();
    std::array<std::uint32_t, HemisphereSamples::sources> open{};
    for (std::size_t first = 0; first < size; first += packet_width) {
      const std::size_t count = std::min(size - first, packet_width);
      samples_.lift(first, packet_.lanes(), lifted_);
      packet_.use(count, lifted_.are_clear);
      packet_.trace();
      for (std::size_t lane = 0; lane < count; ++lane) {
        const std::size_t source = samples_.source(first + lane);
        if constexpr (Rays::finds_nearest) {
          weigh(pixels.front(), lane, source);
        } else {
          open[source] += packet_.is_blocked(lane) ? 0u : 1u;
        }
      }
    }
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      RandomizedEstimate& estimate = pixels[p].estimate;
      estimate.split = pixel_rays_[p].range.split;
      for (std::size_t r = 0; r < max_randomisations; ++r) {
        estimate.open[r] += open[HemisphereSamples::source_of(p, r)];
      }
    }
    statistics_.rays += size;
  }

  void weigh(Pixel& pixel, std::size_t lane, std::size_t randomisation) {
    double open = 1.0;
    if (packet_.is_blocked(lane)) {
      const double distance =
          std::max(static_cast<double>(packet_.distance(lane)) + static_cast<double>(lifted_.step[lane]), 0.0);
      open = 1.0 - falloff_weight(task_.params.ao_falloff, distance, task_.params.ao_distance.number);
      pixel.blocked += 1.0;
      pixel.blocked_distance += distance;
    }
    pixel.estimate.open[randomisation] += open;
    const RayLanes rays = packet_.lanes();
    pixel.open_direction += open * dvec3(rays.dx[lane], rays.dy[lane], rays.dz[lane]);
  }

  // Returns whether the pixel needs more rays.
  bool advance(Pixel& pixel) const {
    const bool was_pilot = pixel.sample_count.is_pilot();
    const bool goes_on = pixel.sample_count.advance(task_.params, pixel.estimate);
    if (was_pilot) {
      pixel.estimate = {};
      pixel.open_direction = dvec3(0.0);
      pixel.blocked = pixel.blocked_distance = 0.0;
    }
    return goes_on;
  }

  void store(const Pixel& pixel, TracedAo& result) const {
    const PixelEstimate& estimate = pixel.sample_count.estimate();
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
  TriangleCache triangles_;
  std::vector<Pixel> pixels_;
  std::vector<PixelRays> pixel_rays_;
  HemisphereSamples samples_;
  LiftedLanes lifted_;
  TraceStatistics statistics_;
};

}  // namespace umbrameter
