// Who casts each surfel's shadow: the first surface on the way to a light.
#pragma once

#include "core/gbuffer.h"
#include "raytrace/tracer.h"

namespace umbrameter {

struct TracedCasters {
  Image<std::uint32_t> instance;  ///< no_id on background, where turned away and where nothing is in the way
  Image<float> distance;  ///< metres from the ray's start, a step off the surfel, to the caster; 0 where none is
  std::uint64_t rays = 0;
};

/// By the rays of trace_visibility() to a light without extent; of one with extent to its middle. Where that calls a
/// surfel blocked there is a caster here, and nowhere else.
TracedCasters trace_casters(const Tracer& tracer, const GBuffer& gbuffer, const Light& light,
                            const Progress& progress = {});

}  // namespace umbrameter
