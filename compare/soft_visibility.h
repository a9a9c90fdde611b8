// Shadow error of an area light. The reference is fractional, so that a tap is neither right nor wrong and the causes
// of a hard shadow's error do not apply. The error is split by sign, with 95 % intervals of the sampling.
#pragma once

#include <cmath>

#include "compare/sampled_error.h"
#include "compare/visibility.h"

namespace umbrameter {

/// How far a pixel of visibility V is in the penumbra: 4V(1 − V), 1 where half of the light is visible, 0 where all or
/// nothing is. It is twice the probability that two random points of the light differ. "V is neither 0 nor 1" is no
/// definition: few rays see a faint penumbra as lit or blocked, so that its pixels would depend on the number of rays.
/// Without bias for a measured visibility with an unbiased estimate of its variance.
inline double penumbra_weight(double visibility, double variance) {
  return 4.0 * (visibility * (1.0 - visibility) + variance);
}

/// The weight times |raster − V|, less the covariance of the measured values of both, so that its mean depends on the
/// number N of rays only by 1/N², as long as noise does not turn the sign of raster − V. Estimates from independent
/// randomisations have a covariance of 4(1 − 2V) Var, because the third moments of v² and of the estimated variance
/// cancel.
inline double penumbra_error(double raster, double visibility, double variance) {
  const double slope = 4.0 * (1.0 - 2.0 * visibility) * variance;
  const double error = raster - visibility;
  return penumbra_weight(visibility, variance) * std::abs(error) + (error < 0.0 ? -slope : slope);
}

struct SoftVisibilityStatistics {
  SampledError error;           ///< over the counted pixels
  Estimate penumbra;            ///< mean penumbra weight of the counted pixels
  Estimate penumbra_mae;        ///< mean |raster − truth|, each pixel with its penumbra weight; 0 without a penumbra
  double penumbra_noise = 0.0;  ///< the most that noise of the truth may have added to penumbra_mae, but for chance
  double mean_texel = 0.0;      ///< mean side of a texel at the counted surfels, metres
};

/// The images have the same size. Surfels that face only a part of the light other than its centre also count, even if
/// the technique only uses the centre: the light that it misses there is part of its error.
SoftVisibilityStatistics analyze_soft_visibility(const Image<float>& raster, const SampledImage& truth,
                                                 const CountedPixels& counted);

Statistics describe(SoftVisibilityStatistics& statistics);

}  // namespace umbrameter
