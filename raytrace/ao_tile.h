// Traces the ambient occlusion of pixels in packets that they share. For raytrace/*.cpp alone.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <mutex>
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
  const TruthParams& params;  ///< of the rays; their reach is below
  double reach = 0.0;         ///< metres from the surface; hits beyond do not count
  std::uint32_t seed = 0;
};

/// A ray with its nearest hit.
struct TracedRay {
  std::size_t randomisation = 0;
  vec3 direction{0, 0, 1};  ///< unit, world
  bool is_blocked = false;
  double distance = 0.0;  ///< of a blocked ray, metres from the surface
};

/// A packet holds rays of similar direction from neighbouring pixels of one triangle. `Quantity` says what the rays of
/// a pixel add up to. It has
///   Rays: OcclusionPacket if the number of open rays is all that it needs, otherwise HitPacket
///   Sums: what it adds up for a pixel besides the open rays
///   Sums start(std::size_t pixel, const RayOrigin&) const: the sums before the first ray
///   double add(Sums&, const TracedRay&) const: adds a ray of a HitPacket and returns 1 − its occlusion
///   void store(std::size_t pixel, const Sums&, const PixelEstimate&) const: writes the result of a pixel
template <class Quantity>
class AoTile {
 public:
  AoTile(const AoTask& task, const Quantity& quantity)
      : task_(task), quantity_(quantity), packet_(task.tracer.state()), triangles_(task.tracer) {}

  void trace(const Tile& tile) {
    for (int y = tile.y_begin; y < tile.y_end; y += block_size) {
      for (int x = tile.x_begin; x < tile.x_end; x += block_size) {
        trace_block({x, y, std::min(x + block_size, tile.x_end), std::min(y + block_size, tile.y_end)});
      }
    }
  }

  const TraceStatistics& statistics() const { return statistics_; }

 private:
  using Rays = typename Quantity::Rays;
  static constexpr int block_size = 8;
  static_assert(std::size_t{block_size} * block_size <= HemisphereSamples::max_pixels);
  // About a third of a megabyte, so that they fit into the L2 cache (docs/decisions/packets-of-neighbours.md).
  static constexpr int max_rays_together = 16384;
  // Sums of floating-point numbers depend on their order, which must not depend on other pixels. Counts do not.
  static constexpr RayOrder ray_order = Rays::finds_nearest ? RayOrder::as_alone : RayOrder::by_direction;

  struct Pixel {
    std::size_t index = 0;
    RayOrigin origin;
    Hemisphere hemisphere;
    AdaptiveSampleCount sample_count;
    typename Quantity::Sums sums;
    RandomizedEstimate estimate{};
    bool needs_more = true;
    int next_rays() const { return sample_count.next().size(); }
  };

  void trace_block(const Tile& block) {
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
    for (const Pixel& pixel : pixels_) quantity_.store(pixel.index, pixel.sums, pixel.sample_count.estimate());
  }

  Pixel start(std::size_t i) {
    const RayOrigin origin = ray_origin(task_.gbuffer, i, triangles_);
    Hemisphere hemisphere;
    hemisphere.normal = vec3(origin.normal);
    const vec3 shading = task_.gbuffer.shading_normal[i];
    const bool uses_shading_normal = task_.params.ao_normal == AoNormal::shading && glm::dot(shading, shading) > 0.0f;
    hemisphere.frame = frame_about(uses_shading_normal ? glm::normalize(shading) : hemisphere.normal);
    hemisphere.offset = origin.offset;
    hemisphere.reach = task_.reach;
    // The margin covers the rounding of the frame and of its product with the direction.
    hemisphere.clear_cosine = static_cast<float>(origin.clear_cosine) + 0x1p-20f;
    statistics_.largest_offset = std::max(statistics_.largest_offset, origin.offset);
    return {i, origin, hemisphere, AdaptiveSampleCount(task_.params), quantity_.start(i, origin)};
  }

  bool may_share(const Pixel& a, const Pixel& b) const {
    const GBuffer& gbuffer = task_.gbuffer;
    return gbuffer.instance[a.index] == gbuffer.instance[b.index] &&
           gbuffer.triangle[a.index] == gbuffer.triangle[b.index] && a.hemisphere == b.hemisphere;
  }

  // Traces pixels that share a triangle and a hemisphere.
  void trace_group(std::span<Pixel> pixels) {
    const std::size_t first = pixels.front().index;
    packet_.set_own_triangle(task_.gbuffer.instance[first], task_.gbuffer.triangle[first]);
    while (!pixels.empty()) {
      for (std::span<Pixel> left = pixels; !left.empty();) {
        const std::size_t size = count_together(left);
        trace_together(left.first(size));
        left = left.subspan(size);
      }
      for (Pixel& pixel : pixels) pixel.needs_more = advance(pixel);
      const auto done =
          std::partition(pixels.begin(), pixels.end(), [](const Pixel& pixel) { return pixel.needs_more; });
      pixels = {pixels.begin(), done};
    }
  }

  // How many pixels to trace together, from the first one on. May reorder the others.
  static std::size_t count_together(std::span<Pixel> pixels) {
    int rays = pixels.front().next_rays();
    if constexpr (ray_order == RayOrder::as_alone) {
      const auto others = std::partition(pixels.begin() + 1, pixels.end(),
                                         [=](const Pixel& pixel) { return pixel.next_rays() == rays; });
      pixels = {pixels.begin(), others};
    }
    std::size_t size = 1;
    for (; size < pixels.size() && rays + pixels[size].next_rays() <= max_rays_together; ++size) {
      rays += pixels[size].next_rays();
    }
    return size;
  }

  void trace_together(std::span<Pixel> pixels) {
    pixel_rays_.clear();
    for (const Pixel& pixel : pixels) {
      const std::uint32_t stream =
          hash(static_cast<std::uint32_t>(pixel.index), pixel.sample_count.is_pilot() ? 1u : 0u, task_.seed);
      pixel_rays_.push_back({vec3(pixel.origin.point), pixel.sample_count.next(), stream});
    }
    samples_.make(task_.params, pixels.front().hemisphere, pixel_rays_, ray_order);
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
          Pixel& pixel = pixels[HemisphereSamples::pixel_of(source)];
          const TracedRay ray = traced_ray(lane, HemisphereSamples::randomisation_of(source));
          pixel.estimate.open[ray.randomisation] += quantity_.add(pixel.sums, ray);
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

  TracedRay traced_ray(std::size_t lane, std::size_t randomisation) {
    const RayLanes rays = packet_.lanes();
    TracedRay ray{randomisation, {rays.dx[lane], rays.dy[lane], rays.dz[lane]}, packet_.is_blocked(lane)};
    if (ray.is_blocked) {
      ray.distance =
          std::max(static_cast<double>(packet_.distance(lane)) + static_cast<double>(lifted_.step[lane]), 0.0);
    }
    return ray;
  }

  // Returns whether the pixel needs more rays.
  bool advance(Pixel& pixel) const {
    const bool was_pilot = pixel.sample_count.is_pilot();
    const bool goes_on = pixel.sample_count.advance(task_.params, pixel.estimate);
    if (was_pilot) {
      pixel.estimate = {};
      pixel.sums = quantity_.start(pixel.index, pixel.origin);
    }
    return goes_on;
  }

  const AoTask& task_;
  const Quantity& quantity_;
  Rays packet_;
  TriangleCache triangles_;
  std::vector<Pixel> pixels_;
  std::vector<PixelRays> pixel_rays_;
  HemisphereSamples samples_;
  LiftedLanes lifted_;
  TraceStatistics statistics_;
};

/// Traces the pixels of an image.
template <class Quantity>
TraceStatistics trace_ao_tiles(const AoTask& task, const Quantity& quantity, const Progress& progress) {
  constexpr int tile_size = 16;
  const auto start = std::chrono::steady_clock::now();
  TraceStatistics statistics;
  std::mutex mutex;
  parallel_tiles(
      task.gbuffer.width, task.gbuffer.height, tile_size,
      [&](const Tile& tile) {
        AoTile<Quantity> pixels(task, quantity);
        pixels.trace(tile);
        task.tracer.state().rays_traced += pixels.statistics().rays;
        const std::lock_guard lock(mutex);
        statistics.add(pixels.statistics());
      },
      progress);
  statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return statistics;
}

}  // namespace umbrameter
