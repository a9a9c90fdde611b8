// Visibility of lights with extent. For raytrace/*.cpp alone: others call trace_visibility().
#pragma once

#include "raytrace/tracer.h"

namespace umbrameter {

/// As trace_visibility(); the light must have extent.
TracedVisibility trace_area_visibility(const Tracer& tracer, const GBuffer& gbuffer, const Light& light,
                                       const TruthSampling& sampling, const Progress& progress);

}  // namespace umbrameter
