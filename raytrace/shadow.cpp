#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <mutex>

#include "raytrace/area_shadow.h"
#include "raytrace/packet.h"
#include "raytrace/packet_width.h"
#include "raytrace/surfel.h"
#include "raytrace/ways.h"
#include "scenes/emitter.h"

namespace umbrameter {
namespace {

constexpr int tile_size = 64;
// A packet takes a few whole columns of a strip: the nearer its rays, the more of their way they go together.
constexpr int strip_height = 4;

constexpr int cache_line = 64;

// Asks for `count` values ahead of their use. Always inline: GCC takes a function that does nothing but this for one
// without effect, and drops its calls.
template <class T>
[[gnu::always_inline]] inline void fetch(const Image<T>& image, std::size_t first, std::size_t count) {
  const char* const bytes = reinterpret_cast<const char*>(image.pixels.data() + first);
  for (std::size_t i = 0; i < count * sizeof(T); i += cache_line) __builtin_prefetch(bytes + i);
}

template <int width>
class ShadowTile {
 public:
  ShadowTile(const Tracer& tracer, const GBuffer& gbuffer, const Ways& ways, Image<float>& visibility)
      : gbuffer_(gbuffer),
        ways_(ways),
        visibility_(visibility),
        packet_(tracer.state(), Coherence::high),
        triangles_(tracer) {}

  void trace(const Tile& tile) {
    fetch_ids(tile, tile.y_begin);
    fetch_ids(tile, tile.y_begin + strip_height);
    fetch_surfels(tile, tile.y_begin);
    for (int top = tile.y_begin; top < tile.y_end; top += strip_height) {
      fetch_ids(tile, top + 2 * strip_height);
      fetch_surfels(tile, top + strip_height);
      trace_strip(tile, top);
    }
    flush();
  }

  const TraceStatistics& statistics() const { return statistics_; }

 private:
  // The G-buffer is larger than the processor's nearer caches, and a tile's rows are too short for it to see ahead. A
  // line of ids comes first and tells whether the rest is wanted.
  [[gnu::always_inline]] void fetch_ids(const Tile& tile, int top) const {
    for (int y = top; y < std::min(top + strip_height, tile.y_end); ++y) {
      fetch(gbuffer_.instance, gbuffer_.instance.index(tile.x_begin, y),
            static_cast<std::size_t>(tile.x_end - tile.x_begin));
    }
  }
  [[gnu::always_inline]] void fetch_surfels(const Tile& tile, int top) const {
    constexpr int ids = cache_line / static_cast<int>(sizeof(std::uint32_t));
    for (int y = top; y < std::min(top + strip_height, tile.y_end); ++y) {
      for (int x = tile.x_begin; x < tile.x_end; x += ids) {
        const std::size_t first = gbuffer_.instance.index(x, y);
        const auto count = static_cast<std::size_t>(std::min(ids, tile.x_end - x));
        if (!gbuffer_.is_surface(first) && !gbuffer_.is_surface(first + count - 1)) continue;
        fetch(gbuffer_.triangle, first, count);
        fetch(gbuffer_.geometric_normal, first, count);
        fetch(gbuffer_.position, first, count);
      }
    }
  }

  struct Pixel {
    std::size_t index;
    SurfelTable::Place triangle;
  };

  void trace_strip(const Tile& tile, int top) {
    const auto width_of_image = static_cast<std::size_t>(gbuffer_.width);
    const auto height = static_cast<std::size_t>(std::min(strip_height, tile.y_end - top));
    const std::size_t begin = gbuffer_.instance.index(tile.x_begin, top);
    const std::size_t end = begin + static_cast<std::size_t>(tile.x_end - tile.x_begin);
    triangles_.make_room(strip_.size());
    std::size_t count = 0;
    for (std::size_t column = begin; column < end; ++column) {
      for (std::size_t i = column; i < column + height * width_of_image; i += width_of_image) {
        if (!gbuffer_.is_surface(i)) continue;
        if (ways_.begin_at(gbuffer_, i)) {
          strip_[count++] = {i, triangles_.place_of(gbuffer_.instance[i], gbuffer_.triangle[i])};
        } else {
          visibility_[i] = 0.0f;
        }
      }
    }
    triangles_.describe();
    for (std::size_t i = 0; i < count; ++i) add(strip_[i]);
    statistics_.rays += count;
  }

  void add(const Pixel& pixel) {
    const SurfelTriangle& triangle = triangles_[pixel.triangle];
    const RayOrigin origin = origin_on(triangle, gbuffer_, pixel.index);
    statistics_.largest_offset = std::max(statistics_.largest_offset, origin.offset);
    pixels_[static_cast<std::size_t>(packet_.size())] = pixel.index;
    packet_.add(ways_.from(origin), triangle.instance, triangle.id);
    if (packet_.is_full()) flush();
  }

  void flush() {
    packet_.trace();
    for (int lane = 0; lane < packet_.size(); ++lane) {
      visibility_[pixels_[static_cast<std::size_t>(lane)]] = packet_.is_blocked(lane) ? 0.0f : 1.0f;
    }
    packet_.clear();
  }

  const GBuffer& gbuffer_;
  const Ways& ways_;
  Image<float>& visibility_;
  OcclusionPacket<width> packet_;
  std::array<std::size_t, static_cast<std::size_t>(width)> pixels_{};
  SurfelTable triangles_;
  std::array<Pixel, static_cast<std::size_t>(strip_height) * tile_size> strip_;  // those that rays leave from
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
