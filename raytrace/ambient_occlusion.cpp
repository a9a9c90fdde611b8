#include <algorithm>
#include <chrono>
#include <mutex>

#include "raytrace/ao_tile.h"

namespace umbrameter {
namespace {

constexpr int tile_size = 16;

template <class Rays>
void trace_tiles(const AoTask& task, TracedAo& traced, const Progress& progress) {
  std::mutex mutex;
  parallel_tiles(
      task.gbuffer.width, task.gbuffer.height, tile_size,
      [&](const Tile& tile) {
        AoTile<Rays> pixels(task);
        pixels.trace(tile, traced);
        task.tracer.state().rays_traced += pixels.statistics().rays;
        const std::lock_guard lock(mutex);
        TraceStatistics& sum = traced.statistics;
        sum.rays += pixels.statistics().rays;
        sum.largest_offset = std::max(sum.largest_offset, pixels.statistics().largest_offset);
      },
      progress);
}

}  // namespace

TracedAo trace_ao(const Tracer& tracer, const GBuffer& gbuffer, const TruthParams& params, std::uint32_t seed,
                  const Progress& progress) {
  check(params);
  const auto start = std::chrono::steady_clock::now();
  const int width = gbuffer.width;
  const int height = gbuffer.height;
  TracedAo traced;
  traced.ao = Image<float>(width, height, 1.0f);
  traced.standard_error = traced.variance = traced.samples = Image<float>(width, height, 0.0f);
  const AoLayers layers = params.ao_layers;
  if (layers == AoLayers::bent_normal || layers == AoLayers::all) {
    traced.bent_normal = Image<vec3>(width, height, vec3(0));
  }
  if (layers == AoLayers::hit_distance || layers == AoLayers::all) {
    traced.hit_distance = Image<float>(width, height, std::numeric_limits<float>::infinity());
  }
  traced.degrees_of_freedom = degrees_of_freedom(params);
  const AoTask task{tracer, gbuffer, params, seed};
  if (params.ao_falloff != AoFalloff::none || layers != AoLayers::none) {
    trace_tiles<HitPacket>(task, traced, progress);
  } else {
    trace_tiles<Packet>(task, traced, progress);
  }
  traced.precision = precision_of(traced.standard_error, traced.samples, params);
  traced.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return traced;
}

}  // namespace umbrameter
