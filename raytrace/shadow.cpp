#include <algorithm>
#include <array>
#include <chrono>
#include <mutex>

#include "raytrace/area_shadow.h"
#include "raytrace/packet.h"
#include "raytrace/shadow_ray_generator.h"
#include "raytrace/surfel.h"
#include "raytrace/vectors.h"
#include "scenes/emitter.h"

namespace umbrameter {
namespace {

constexpr int shadow_tile_size = 64;
// A packet covers a few whole columns of a strip: the nearer its rays, the longer they traverse the same boxes.
constexpr int strip_height = 4;

// Holds the rays of a strip after those left over from the strip before, which did not fill a packet.
constexpr std::size_t max_rays = std::size_t{strip_height} * shadow_tile_size + packet_width;
using StripRays = RayColumns<max_rays>;

// Whether any pixel shows a surface. Branch-free, so that it vectorises.
UMBRAMETER_VECTORS bool has_surface(const std::uint32_t* instances, std::size_t count) {
  unsigned found = 0;
  for (std::size_t i = 0; i < count; ++i) found |= instances[i] != no_id ? 1u : 0u;
  return found != 0;
}

// Sets the flags of the surfels that face a distant light.
UMBRAMETER_VECTORS void find_facing(const vec3* __restrict normals, std::size_t count, const dvec3 to_light,
                                    std::uint8_t* __restrict is_facing) {
  for (std::size_t i = 0; i < count; ++i) is_facing[i] = glm::dot(dvec3(normals[i]), to_light) > 0.0 ? 1 : 0;
}

// Sets visibility where no ray decides it: 0 on back-facing surfels, 1 on the background. Clears the background's
// flags.
UMBRAMETER_VECTORS void set_without_rays(const std::uint32_t* __restrict instances, std::size_t count,
                                         std::uint8_t* __restrict is_facing, float* __restrict visibility) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t is_surface = instances[i] != no_id ? 1 : 0;
    is_facing[i] = is_facing[i] & is_surface;
    visibility[i] = is_facing[i] == is_surface ? 1.0f : 0.0f;
  }
}

// Makes the rays of the pixels from `first` to `end`. Returns the largest offset of their origins.
UMBRAMETER_VECTORS double make_rays(const ShadowRayGenerator& generator, const GBuffer& gbuffer,
                                    TriangleCache& triangles, const std::size_t* pixels, std::size_t first,
                                    std::size_t end, StripRays& rays) {
  double largest = 0.0;
  for (std::size_t i = first; i < end; ++i) {
    const RayOrigin origin = ray_origin(gbuffer, pixels[i], triangles);
    largest = std::max(largest, origin.offset);
    rays.set(i, generator.ray_from(origin), gbuffer.instance[pixels[i]], gbuffer.triangle[pixels[i]]);
  }
  return largest;
}

class ShadowTile {
 public:
  ShadowTile(const Tracer& tracer, const GBuffer& gbuffer, const ShadowRayGenerator& generator,
             Image<float>& visibility)
      : gbuffer_(gbuffer),
        generator_(generator),
        visibility_(visibility),
        packet_(tracer.state(), Coherence::high),
        triangles_(tracer) {}

  void trace(const Tile& tile) {
    for (int top = tile.y_begin; top < tile.y_end; top += strip_height) {
      trace_strip({tile.x_begin, top, tile.x_end, std::min(top + strip_height, tile.y_end)});
    }
    trace_packet(0, left_over_);
  }

  const TraceStatistics& statistics() const { return statistics_; }

 private:
  void trace_strip(const Tile& strip) {
    const std::size_t count = collect(strip);
    const double offset = make_rays(generator_, gbuffer_, triangles_, pixels_.data(), left_over_, count, rays_);
    statistics_.largest_offset = std::max(statistics_.largest_offset, offset);
    statistics_.rays += count - left_over_;
    std::size_t traced = 0;
    for (; traced + packet_width <= count; traced += packet_width) trace_packet(traced, packet_width);
    left_over_ = count - traced;
    rays_.move_to_front(traced, left_over_);
    std::copy_n(pixels_.data() + traced, left_over_, pixels_.data());
  }

  // Appends the pixels that need rays, column by column, sets the visibility of all others, and returns the number of
  // rays. The loops have no branch that depends on a pixel, because the processor would mispredict it.
  std::size_t collect(const Tile& strip) {
    const int height = strip.y_end - strip.y_begin;
    const auto columns = static_cast<std::size_t>(strip.x_end - strip.x_begin);
    std::array<std::array<std::uint8_t, shadow_tile_size>, strip_height> is_facing;
    for (int row = 0; row < height; ++row) {
      const std::size_t first = gbuffer_.instance.index(strip.x_begin, strip.y_begin + row);
      std::uint8_t* const flags = is_facing[static_cast<std::size_t>(row)].data();
      if (!has_surface(&gbuffer_.instance[first], columns)) {
        std::fill_n(flags, columns, std::uint8_t{0});
      } else if (generator_.is_distant()) {
        find_facing(&gbuffer_.geometric_normal[first], columns, generator_.to_distant(), flags);
      } else {
        for (std::size_t x = 0; x < columns; ++x) flags[x] = generator_.is_facing(gbuffer_, first + x) ? 1 : 0;
      }
      set_without_rays(&gbuffer_.instance[first], columns, flags, &visibility_[first]);
    }
    std::size_t count = left_over_;
    for (std::size_t x = 0; x < columns; ++x) {
      std::size_t pixel = gbuffer_.instance.index(strip.x_begin, strip.y_begin) + x;
      for (int row = 0; row < height; ++row, pixel += static_cast<std::size_t>(gbuffer_.width)) {
        pixels_[count] = pixel;
        count += is_facing[static_cast<std::size_t>(row)][x];
      }
    }
    return count;
  }

  void trace_packet(std::size_t first, std::size_t count) {
    packet_.take(rays_, first, count);
    packet_.trace();
    for (std::size_t lane = 0; lane < count; ++lane) {
      visibility_[pixels_[first + lane]] = packet_.is_blocked(lane) ? 0.0f : 1.0f;
    }
  }

  const GBuffer& gbuffer_;
  const ShadowRayGenerator& generator_;
  Image<float>& visibility_;
  OcclusionPacket packet_;
  TriangleCache triangles_;
  std::size_t left_over_ = 0;  // rays at the front that did not fill a packet
  StripRays rays_;
  std::array<std::size_t, max_rays> pixels_;
  TraceStatistics statistics_;
};

TracedVisibility trace_hard_visibility(const Tracer& tracer, const GBuffer& gbuffer, const Light& light,
                                       const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  TracedVisibility traced;
  traced.visibility = Image<float>(gbuffer.width, gbuffer.height, 1.0f);
  const ShadowRayGenerator generator(light);
  std::mutex mutex;
  parallel_tiles(
      gbuffer.width, gbuffer.height, shadow_tile_size,
      [&](const Tile& tile) {
        ShadowTile pixels(tracer, gbuffer, generator, traced.visibility);
        pixels.trace(tile);
        tracer.state().rays_traced += pixels.statistics().rays;
        const std::lock_guard lock(mutex);
        traced.statistics.add(pixels.statistics());
      },
      progress);
  traced.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return traced;
}

}  // namespace

TracedVisibility trace_visibility(const Tracer& tracer, const GBuffer& gbuffer, const Light& light,
                                  const TruthSampling& sampling, const Progress& progress) {
  if (is_area(light)) return trace_area_visibility(tracer, gbuffer, light, sampling, progress);
  return trace_hard_visibility(tracer, gbuffer, light, progress);
}

}  // namespace umbrameter
