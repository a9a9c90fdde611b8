#include "raytrace/casters.h"

#include <array>
#include <atomic>

#include "raytrace/hit_packet.h"
#include "raytrace/packet_width.h"
#include "raytrace/ways.h"

namespace umbrameter {
namespace {

constexpr int tile_size = 64;
constexpr int width = hit_packet_width;

class CasterTile {
 public:
  CasterTile(const Tracer& tracer, const GBuffer& gbuffer, const Ways& ways, TracedCasters& casters)
      : tracer_(tracer),
        gbuffer_(gbuffer),
        ways_(ways),
        casters_(casters),
        packet_(tracer.state()),
        triangles_(tracer) {}

  std::uint64_t trace(const Tile& tile) {
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
      for (int x = tile.x_begin; x < tile.x_end; ++x) add(gbuffer_.instance.index(x, y));
    }
    flush();
    return rays_;
  }

 private:
  void add(std::size_t i) {
    if (!gbuffer_.is_surface(i) || !ways_.begin_at(gbuffer_, i)) return;
    const RayOrigin origin = ray_origin(gbuffer_, i, triangles_);
    pixels_[static_cast<std::size_t>(packet_.size())] = i;
    packet_.add(ways_.from(origin), gbuffer_.instance[i], gbuffer_.triangle[i]);
    ++rays_;
    if (packet_.is_full()) flush();
  }

  void flush() {
    packet_.trace();
    for (int lane = 0; lane < packet_.size(); ++lane) {
      if (!packet_.is_blocked(lane)) continue;
      const std::size_t pixel = pixels_[static_cast<std::size_t>(lane)];
      casters_.instance[pixel] = packet_.instance(lane);
      casters_.distance[pixel] = packet_.distance(lane);
    }
    packet_.clear();
  }

  const Tracer& tracer_;
  const GBuffer& gbuffer_;
  const Ways& ways_;
  TracedCasters& casters_;
  HitPacket<width> packet_;
  std::array<std::size_t, static_cast<std::size_t>(width)> pixels_{};
  SurfelTable triangles_;
  std::uint64_t rays_ = 0;
};

}  // namespace

TracedCasters trace_casters(const Tracer& tracer, const GBuffer& gbuffer, const Light& light,
                            const Progress& progress) {
  TracedCasters casters{Image<std::uint32_t>(gbuffer.width, gbuffer.height, no_id),
                        Image<float>(gbuffer.width, gbuffer.height, 0.0f)};
  const Ways ways(light);
  std::atomic<std::uint64_t> rays{0};
  parallel_tiles(
      gbuffer.width, gbuffer.height, tile_size,
      [&](const Tile& tile) { rays += CasterTile(tracer, gbuffer, ways, casters).trace(tile); }, progress);
  casters.rays = rays;
  return casters;
}

}  // namespace umbrameter
