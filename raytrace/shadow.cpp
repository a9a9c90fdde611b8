#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <mutex>

#include "raytrace/area_shadow.h"
#include "raytrace/packet.h"
#include "raytrace/packet_width.h"
#include "raytrace/surfel.h"
#include "raytrace/vectors.h"
#include "raytrace/ways.h"
#include "scenes/emitter.h"

namespace umbrameter {
namespace {

constexpr int tile_size = 64;
// A packet takes a few whole columns of a strip: the nearer its rays, the more of their way they go together.
constexpr int strip_height = 4;

constexpr int most_in_strip = strip_height * tile_size;
constexpr std::size_t widest_packet = 16;
// Rays of a strip, and those that did not fill a packet of the strip before.
constexpr std::size_t most_rays = most_in_strip + widest_packet;
using StripRays = RayColumns<most_rays>;

// Asks for memory ahead of its use, a few cache lines at a time: of many at once the processor waits for the first.
class Fetcher {
 public:
  template <class T>
  void plan(const Image<T>& image, std::size_t first, std::size_t count) {
    const char* const bytes = reinterpret_cast<const char*>(image.pixels.data() + first);
    for (std::size_t i = 0; i < count * sizeof(T); i += line) lines_[planned_++] = bytes + i;
  }
  // Always inline: GCC takes a function that does nothing but this for one without effect, and drops its calls.
  [[gnu::always_inline]] void fetch(std::size_t lines) {
    const std::size_t end = std::min(fetched_ + lines, planned_);
    for (; fetched_ < end; ++fetched_) __builtin_prefetch(lines_[fetched_]);
  }
  [[gnu::always_inline]] void finish() {
    fetch(planned_);
    planned_ = fetched_ = 0;
  }

  static constexpr std::size_t line = 64;
  // By pixel of a strip: two ids, a position, a normal and the result.
  static constexpr std::size_t most =
      most_in_strip * (2 * sizeof(std::uint32_t) + 2 * sizeof(vec3) + sizeof(float)) / line;

 private:
  std::size_t planned_ = 0;
  std::size_t fetched_ = 0;
  std::array<const char*, most> lines_;
};

// Whether any of the surfels is one. Without branches, so that it becomes vectors.
UMBRAMETER_VECTORS bool has_surface(const std::uint32_t* instances, std::size_t count) {
  unsigned found = 0;
  for (std::size_t i = 0; i < count; ++i) found |= instances[i] != no_id ? 1u : 0u;
  return found != 0;
}

// Whether surfels are turned to a distant light.
UMBRAMETER_VECTORS void find_turned(const vec3* __restrict normals, std::size_t count, const dvec3 to_light,
                                    std::uint8_t* __restrict turned) {
  for (std::size_t i = 0; i < count; ++i) {
    turned[i] = is_turned(normals[i], to_light) ? 1 : 0;
  }
}

// The visibility of a row where no ray is needed: surfels that are turned away see nothing of the light, background is
// open. Turned ones go on to be those that rays leave from.
UMBRAMETER_VECTORS void settle(const std::uint32_t* __restrict instances, std::size_t count,
                               std::uint8_t* __restrict turned, float* __restrict visibility) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t is_surface = instances[i] != no_id ? 1 : 0;
    turned[i] = turned[i] & is_surface;
    visibility[i] = turned[i] == is_surface ? 1.0f : 0.0f;
  }
}

// Returns the largest offset among their origins.
UMBRAMETER_VECTORS double aim_rays(const Ways& ways, const GBuffer& gbuffer, const SurfelTable& triangles,
                                   const SurfelTable::Place* places, const std::size_t* pixels, std::size_t first,
                                   std::size_t end, StripRays& rays) {
  double largest = 0.0;
  for (std::size_t i = first; i < end; ++i) {
    const RayOrigin origin = origin_on(triangles[places[i]], gbuffer, pixels[i]);
    largest = std::max(largest, origin.offset);
    rays.set(i, ways.from(origin));
  }
  return largest;
}

template <int width>
class ShadowTile {
  static_assert(width <= widest_packet);

 public:
  ShadowTile(const Tracer& tracer, const GBuffer& gbuffer, const Ways& ways, Image<float>& visibility)
      : gbuffer_(gbuffer),
        ways_(ways),
        visibility_(visibility),
        packet_(tracer.state(), Coherence::high),
        triangles_(tracer) {}

  void trace(const Tile& tile) {
    plan_ids(tile, tile.y_begin);
    fetcher_.finish();
    plan_ids(tile, tile.y_begin + strip_height);
    plan_surfels(tile, tile.y_begin);
    fetcher_.finish();
    for (int top = tile.y_begin; top < tile.y_end; top += strip_height) {
      plan_ids(tile, top + 2 * strip_height);
      plan_surfels(tile, top + strip_height);
      trace_strip(tile, top);
      fetcher_.finish();
    }
    trace_packet(0, static_cast<int>(waiting_));
  }

  const TraceStatistics& statistics() const { return statistics_; }

 private:
  // The G-buffer is larger than the processor's nearer caches, and a tile's rows are too short for it to see ahead. A
  // line of ids comes first and tells whether the rest is wanted.
  void plan_ids(const Tile& tile, int top) {
    for (int y = top; y < std::min(top + strip_height, tile.y_end); ++y) {
      fetcher_.plan(gbuffer_.instance, gbuffer_.instance.index(tile.x_begin, y),
                    static_cast<std::size_t>(tile.x_end - tile.x_begin));
    }
  }
  void plan_surfels(const Tile& tile, int top) {
    constexpr int ids = Fetcher::line / sizeof(std::uint32_t);
    for (int y = top; y < std::min(top + strip_height, tile.y_end); ++y) {
      for (int x = tile.x_begin; x < tile.x_end; x += ids) {
        const std::size_t first = gbuffer_.instance.index(x, y);
        const auto count = static_cast<std::size_t>(std::min(ids, tile.x_end - x));
        fetcher_.plan(visibility_, first, count);
        if (!gbuffer_.is_surface(first) && !gbuffer_.is_surface(first + count - 1)) continue;
        fetcher_.plan(gbuffer_.triangle, first, count);
        fetcher_.plan(gbuffer_.geometric_normal, first, count);
        fetcher_.plan(gbuffer_.position, first, count);
      }
    }
  }

  void trace_strip(const Tile& tile, int top) {
    const std::size_t count = collect(tile, top);
    triangles_.make_room(count - waiting_);
    for (std::size_t i = waiting_; i < count; ++i) {
      rays_.instance[i] = gbuffer_.instance[pixels_[i]];
      rays_.triangle[i] = gbuffer_.triangle[pixels_[i]];
      places_[i] = triangles_.place_of(rays_.instance[i], rays_.triangle[i]);
    }
    triangles_.describe();
    const double offset = aim_rays(ways_, gbuffer_, triangles_, places_.data(), pixels_.data(), waiting_, count, rays_);
    statistics_.largest_offset = std::max(statistics_.largest_offset, offset);
    statistics_.rays += count - waiting_;

    constexpr std::size_t lines_a_packet = Fetcher::most * width / most_in_strip + 1;
    std::size_t traced = 0;
    for (; traced + width <= count; traced += width) {
      fetcher_.fetch(lines_a_packet);
      trace_packet(traced, width);
    }
    waiting_ = count - traced;
    rays_.move_to_front(traced, waiting_);
    std::copy_n(pixels_.data() + traced, waiting_, pixels_.data());
  }

  // Puts the strip's pixels that rays leave from behind those that wait, column by column, and settles all others.
  // Without branches that depend on a pixel: the processor would guess them wrong.
  std::size_t collect(const Tile& tile, int top) {
    const int height = std::min(strip_height, tile.y_end - top);
    const auto columns = static_cast<std::size_t>(tile.x_end - tile.x_begin);
    bool is_any = false;
    for (int row = 0; row < height; ++row) {
      const std::size_t first = gbuffer_.instance.index(tile.x_begin, top + row);
      std::array<std::uint8_t, tile_size>& turned = turned_[static_cast<std::size_t>(row)];
      if (!has_surface(&gbuffer_.instance[first], columns)) {
        turned.fill(0);
        std::fill_n(&visibility_[first], columns, 1.0f);
        continue;
      }
      is_any = true;
      if (ways_.is_distant()) {
        find_turned(&gbuffer_.geometric_normal[first], columns, ways_.to_distant(), turned.data());
      } else {
        for (std::size_t x = 0; x < columns; ++x) turned[x] = ways_.begin_at(gbuffer_, first + x) ? 1 : 0;
      }
      settle(&gbuffer_.instance[first], columns, turned.data(), &visibility_[first]);
    }
    std::size_t count = waiting_;
    if (!is_any) return count;
    for (std::size_t x = 0; x < columns; ++x) {
      std::size_t pixel = gbuffer_.instance.index(tile.x_begin, top) + x;
      for (int row = 0; row < height; ++row, pixel += static_cast<std::size_t>(gbuffer_.width)) {
        pixels_[count] = pixel;
        count += turned_[static_cast<std::size_t>(row)][x];
      }
    }
    return count;
  }

  void trace_packet(std::size_t first, int count) {
    packet_.take(rays_, first, count);
    packet_.trace();
    for (int lane = 0; lane < count; ++lane) {
      visibility_[pixels_[first + static_cast<std::size_t>(lane)]] = packet_.is_blocked(lane) ? 0.0f : 1.0f;
    }
  }

  const GBuffer& gbuffer_;
  const Ways& ways_;
  Image<float>& visibility_;
  OcclusionPacket<width> packet_;
  Fetcher fetcher_;
  SurfelTable triangles_;
  std::array<std::array<std::uint8_t, tile_size>, strip_height> turned_;
  std::size_t waiting_ = 0;  // rays that did not fill a packet: the first ones
  StripRays rays_;
  std::array<std::size_t, most_rays> pixels_;
  std::array<SurfelTable::Place, most_rays> places_;
  TraceStatistics statistics_;
};

template <int width>
TracedVisibility trace(const ShadowTask& task, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  TracedVisibility traced;
  traced.visibility = Image<float>(task.gbuffer.width, task.gbuffer.height, 1.0f);
  const Ways ways(task.light);
  std::mutex mutex;
  parallel_tiles(
      task.gbuffer.width, task.gbuffer.height, tile_size,
      [&](const Tile& tile) {
        ShadowTile<width> pixels(task.tracer, task.gbuffer, ways, traced.visibility);
        pixels.trace(tile);
        task.tracer.state().rays_traced += pixels.statistics().rays;
        const std::lock_guard lock(mutex);
        traced.statistics.rays += pixels.statistics().rays;
        traced.statistics.largest_offset =
            std::max(traced.statistics.largest_offset, pixels.statistics().largest_offset);
      },
      progress);
  traced.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return traced;
}

}  // namespace

TracedVisibility trace_visibility(const Tracer& tracer, const GBuffer& gbuffer, const Light& light,
                                  const TruthSampling& sampling, const Progress& progress) {
  if (is_area(light)) return trace_area_visibility(tracer, gbuffer, light, sampling, progress);
  return trace_sharp_visibility_in_packets(occlusion_packet_width(tracer), {tracer, gbuffer, light}, progress);
}

TracedVisibility trace_sharp_visibility_in_packets(int width, const ShadowTask& task, const Progress& progress) {
  if (width == 4) return trace<4>(task, progress);
  if (width == 16) return trace<16>(task, progress);
  assert(width == 8);
  return trace<8>(task, progress);
}

}  // namespace umbrameter
