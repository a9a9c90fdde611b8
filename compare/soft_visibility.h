// Shadow error of an area light. The reference is fractional, so that a tap is neither right nor wrong and the causes
// of a hard shadow's error do not apply. The error is split by sign, with 95 % intervals of the sampling.
#pragma once

#include <vector>

#include "compare/sampled_error.h"
#include "compare/visibility.h"

namespace umbrameter {

struct SoftVisibilityStatistics {
  SampledError error;       ///< over the counted pixels
  double penumbra = 0.0;    ///< share of the counted pixels where the truth is neither 0 nor 1
  Estimate penumbra_mae;    ///< mean |raster − truth| over these pixels; 0 without any
  double mean_texel = 0.0;  ///< mean side of a texel at the counted surfels, metres
};

/// The images have the same size. Surfels that face only a part of the light other than its centre also count, even if
/// the technique only uses the centre: the light that it misses there is part of its error.
SoftVisibilityStatistics analyze_soft_visibility(const Image<float>& raster, const SampledImage& truth,
                                                 const CountedPixels& counted);

Statistics describe(SoftVisibilityStatistics& statistics);

}  // namespace umbrameter
