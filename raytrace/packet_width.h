// The reference with packets of a chosen width. For raytrace/*.cpp and tests.
#pragma once

#include "raytrace/tracer.h"

namespace umbrameter {

/// The fastest numbers of rays a packet (docs/decisions/packets-of-neighbours.md): of occlusion rays on this processor,
/// and of rays to their nearest hits.
int occlusion_packet_width(const Tracer& tracer);
inline constexpr int hit_packet_width = 8;

/// What every tile of one image has in common.
struct AoTask {
  const Tracer& tracer;
  const GBuffer& gbuffer;
  const TruthParams& params;
  std::uint32_t seed = 0;
};

/// trace_ao() with packets of 4, 8 or 16 rays, which changes no bit of the result.
TracedAo trace_ao_in_packets(int width, const AoTask& task, const Progress& progress = {});

struct ShadowTask {
  const Tracer& tracer;
  const GBuffer& gbuffer;
  const Light& light;  ///< without extent
};

/// trace_visibility() likewise.
TracedVisibility trace_sharp_visibility_in_packets(int width, const ShadowTask& task, const Progress& progress = {});

}  // namespace umbrameter
