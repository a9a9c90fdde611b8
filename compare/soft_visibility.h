// Shadow error of a light with extent. Its reference is a share, so that no tap is right or wrong by itself and the
// causes of a hard shadow's error do not apply: the error is split by sign, with the interval of the sampling.
#pragma once

#include <vector>

#include "compare/sampled_error.h"
#include "compare/visibility.h"

namespace umbrameter {

struct SoftVisibilityStatistics {
  SampledError error;       ///< over the counted pixels
  double penumbra = 0.0;    ///< share of them that the truth calls neither 0 nor 1
  double mean_texel = 0.0;  ///< mean side of a texel at the counted surfels, metres
};

/// Images of one size. Where the raster's technique knows the middle of the light alone, surfels that face only another
/// part of it count as well: what it misses there is its error.
SoftVisibilityStatistics analyze_soft_visibility(const Image<float>& raster, const SampledImage& truth,
                                                 const CountedPixels& counted);

Statistics describe(SoftVisibilityStatistics& statistics);

}  // namespace umbrameter
