// Visibility averaged over the part of each pixel's footprint that shows the surface of its centre: what an antialiased
// shadow should be.
#pragma once

#include "raytrace/tracer.h"

namespace umbrameter {

/// For each pixel the mean visibility over the points of its square, uniformly drawn, that see the surface of the
/// centre's surfel: the same instance, at most 30° off the surfel's plane as seen from it and with a normal within 45°
/// of its normal. Each point sends one ray to the light, or to a random point of an area light. As many points, and the
/// same intervals, as for an area light (TracedVisibility); 0 where the surfel faces away. `view` is that of the
/// G-buffer.
TracedVisibility trace_pixel_visibility(const Tracer& tracer, const GBuffer& gbuffer, const View& view,
                                        const Light& light, const TruthSampling& sampling,
                                        const Progress& progress = {});

}  // namespace umbrameter
