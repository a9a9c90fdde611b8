#include "raytrace/casters.h"

#include <array>
#include <atomic>

#include "raytrace/packet.h"
#include "raytrace/shadow_ray_generator.h"

namespace umbrameter {
namespace {

// Returns the number of rays.
std::uint64_t trace_tile(const Tracer& tracer, const GBuffer& gbuffer, const ShadowRayGenerator& generator,
                         const Tile& tile, TracedCasters& casters) {
  HitPacket packet(tracer.state());
  TriangleCache triangles(tracer);
  std::array<std::size_t, packet_width> pixels;
  std::uint64_t rays = 0;
  const auto trace_packet = [&] {
    packet.trace();
    for (std::size_t lane = 0; lane < packet.size(); ++lane) {
      if (!packet.is_blocked(lane)) continue;
      casters.instance[pixels[lane]] = packet.instance(lane);
      casters.distance[pixels[lane]] = packet.distance(lane);
    }
    rays += packet.size();
    packet.clear();
  };
  for (int y = tile.y_begin; y < tile.y_end; ++y) {
    for (int x = tile.x_begin; x < tile.x_end; ++x) {
      const std::size_t i = gbuffer.instance.index(x, y);
      if (!gbuffer.is_surface(i) || !generator.is_facing(gbuffer, i)) continue;
      pixels[packet.size()] = i;
      packet.add(generator.ray_from(ray_origin(gbuffer, i, triangles)), gbuffer.instance[i], gbuffer.triangle[i]);
      if (packet.is_full()) trace_packet();
    }
  }
  trace_packet();
  return rays;
}

}  // namespace

TracedCasters trace_casters(const Tracer& tracer, const GBuffer& gbuffer, const Light& light,
                            const Progress& progress) {
  constexpr int tile_size = 64;
  TracedCasters casters{Image<std::uint32_t>(gbuffer.width, gbuffer.height, no_id),
                        Image<float>(gbuffer.width, gbuffer.height, 0.0f)};
  const ShadowRayGenerator generator(light);
  std::atomic<std::uint64_t> rays{0};
  parallel_tiles(
      gbuffer.width, gbuffer.height, tile_size,
      [&](const Tile& tile) { rays += trace_tile(tracer, gbuffer, generator, tile, casters); }, progress);
  casters.rays = rays;
  return casters;
}

}  // namespace umbrameter
