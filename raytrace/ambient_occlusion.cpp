#include <algorithm>
#include <cassert>
#include <chrono>
#include <mutex>

#include "raytrace/ao_tile.h"
#include "raytrace/hit_packet.h"

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
        TraceStatistics& sum = traced.statistics;
        sum.rays += pixels.statistics().rays;
        sum.largest_offset = std::max(sum.largest_offset, pixels.statistics().largest_offset);
      },
      progress);
}

template <int width>
TracedAo trace(const AoTask& task, const Progress& progress) {
  const TruthParams& params = task.params;
  const GBuffer& gbuffer = task.gbuffer;
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
  if (needs_hits(params)) {
    trace_tiles<HitPacket<width>>(task, traced, progress);
  } else {
    trace_tiles<OcclusionPacket<width>>(task, traced, progress);
  }
  traced.precision = precision_of(traced.standard_error, traced.samples, params);
  traced.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return traced;
}

}  // namespace

TracedAo trace_ao(const Tracer& tracer, const GBuffer& gbuffer, const TruthParams& params, std::uint32_t seed,
                  const Progress& progress) {
  const int width = needs_hits(params) ? hit_packet_width : occlusion_packet_width(tracer);
  return trace_ao_in_packets(width, {tracer, gbuffer, params, seed}, progress);
}

TracedAo trace_ao_in_packets(int width, const AoTask& task, const Progress& progress) {
  if (width == 4) return trace<4>(task, progress);
  if (width == 16) return trace<16>(task, progress);
  assert(width == 8);
  return trace<8>(task, progress);
}

}  // namespace umbrameter
