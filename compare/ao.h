// Ambient-occlusion error against a sampled reference, with the interval that the sampling leaves.
#pragma once

#include "compare/sampled_error.h"
#include "core/gbuffer.h"
#include "core/image.h"

namespace umbrameter {

/// Over all surfels; accessibility, 1 is open.
struct AoStatistics {
  SampledError error;
};
Statistics describe(AoStatistics& statistics);

AoStatistics analyze_ao(const Image<float>& raster, const SampledImage& truth, const GBuffer& gbuffer);

}  // namespace umbrameter
