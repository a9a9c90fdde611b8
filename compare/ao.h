// Ambient-occlusion error against a sampled reference, with 95 % intervals of the sampling.
#pragma once

#include "compare/sampled_error.h"
#include "core/gbuffer.h"
#include "core/image.h"

namespace umbrameter {

/// The error of accessibility (1 is open) over all surfels.
struct AoStatistics {
  SampledError error;
};
Statistics describe(AoStatistics& statistics);

AoStatistics analyze_ao(const Image<float>& raster, const SampledImage& truth, const GBuffer& gbuffer);

}  // namespace umbrameter
