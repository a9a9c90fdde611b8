// Traces the visibility of a light in tiles, with several randomisations per pixel. For raytrace/*.cpp alone.
#pragma once

#include <chrono>
#include <mutex>

#include "core/parallel.h"
#include "raytrace/adaptive_sampling.h"
#include "raytrace/tracer.h"
#include "raytrace/tracer_state.h"

namespace umbrameter {

/// `make_tile_tracer` is called once per tile; what it returns has trace(const Tile&, TracedVisibility&) and
/// statistics(). Pixels that it does not write are lit.
template <class MakeTileTracer>
TracedVisibility trace_tiles(const Tracer& tracer, const GBuffer& gbuffer, const TruthParams& params, int tile_size,
                             const Progress& progress, const MakeTileTracer& make_tile_tracer) {
  check(params);
  const auto start = std::chrono::steady_clock::now();
  const Image<float> none(gbuffer.width, gbuffer.height, 0.0f);
  TracedVisibility traced{
      Image<float>(gbuffer.width, gbuffer.height, 1.0f), {}, none, none, none, degrees_of_freedom(params)};
  std::mutex mutex;
  parallel_tiles(
      gbuffer.width, gbuffer.height, tile_size,
      [&](const Tile& tile) {
        auto tracing = make_tile_tracer();
        tracing.trace(tile, traced);
        tracer.state().rays_traced += tracing.statistics().rays;
        const std::lock_guard lock(mutex);
        traced.statistics.add(tracing.statistics());
      },
      progress);
  traced.precision = precision_of(traced.standard_error, traced.samples, params);
  traced.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return traced;
}

}  // namespace umbrameter
