#include <chrono>
#include <mutex>

#include "raytrace/ao_tile.h"

namespace umbrameter {
namespace {

constexpr int tile_size = 16;

bool needs_hits(const TruthParams& params) {
  return params.ao_falloff != AoFalloff::none || params.ao_layers != AoLayers::none;
}

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
        traced.statistics.add(pixels.statistics());
      },
      progress);
}

}  // namespace

TracedAo trace_ao(const Tracer& tracer, const GBuffer& gbuffer, const TruthParams& params, std::uint32_t seed,
                  const Progress& progress) {
  check(params);
  const auto start = std::chrono::steady_clock::now();
  TracedAo traced;
  traced.ao = Image<float>(gbuffer.width, gbuffer.height, 1.0f);
  traced.standard_error = traced.variance = traced.samples = Image<float>(gbuffer.width, gbuffer.height, 0.0f);
  const AoLayers layers = params.ao_layers;
  if (layers == AoLayers::bent_normal || layers == AoLayers::all) {
    traced.bent_normal = Image<vec3>(gbuffer.width, gbuffer.height, vec3(0));
  }
  if (layers == AoLayers::hit_distance || layers == AoLayers::all) {
    traced.hit_distance = Image<float>(gbuffer.width, gbuffer.height, std::numeric_limits<float>::infinity());
  }
  traced.degrees_of_freedom = degrees_of_freedom(params);
  const AoTask task{tracer, gbuffer, params, seed};
  if (needs_hits(params)) {
    trace_tiles<HitPacket>(task, traced, progress);
  } else {
    trace_tiles<OcclusionPacket>(task, traced, progress);
  }
  traced.precision = precision_of(traced.standard_error, traced.samples, params);
  traced.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return traced;
}

}  // namespace umbrameter
