// The instance that casts the shadow on each surfel: the first surface on the ray to a light.
#pragma once

#include "core/gbuffer.h"
#include "raytrace/tracer.h"

namespace umbrameter {

struct TracedCasters {
  Image<std::uint32_t> instance;  ///< no_id on the background, on back-facing and on lit surfels
  Image<float> distance;          ///< metres from the ray's origin to the caster; 0 without one
  std::uint64_t rays = 0;
};

/// Traces the rays of trace_visibility(), to the centre of a light with extent. For a light without extent, exactly the
/// surfels that trace_visibility() finds blocked have a caster.
TracedCasters trace_casters(const Tracer& tracer, const GBuffer& gbuffer, const Light& light,
                            const Progress& progress = {});

}  // namespace umbrameter
