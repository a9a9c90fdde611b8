// The mean, interval and required number of rays of a pixel, from independent randomisations of its rays. For ambient
// occlusion and area lights. For raytrace/*.cpp and tests.
#pragma once

#include <array>

#include "raytrace/sampler.h"
#include "techniques/truth/parameters.h"

namespace umbrameter {

/// The sum of each randomisation's rays. Weighted rays are replaced by equivalent ones of equal weight.
struct RandomizedEstimate {
  Randomisations split{1, 0};
  /// Effective sample size over the number of rays (Kish): 1 for equal weights.
  double effective_share = 1.0;
  std::array<double, max_randomisations> open{};  ///< sum of 1 − occlusion over the randomisation's rays

  double mean() const;
  /// Unbiased estimate of the variance of mean(), from the scatter of the randomisations' means. 0 if they are equal.
  double variance() const;
};

/// Half width of the 95 % interval divided by Student's t quantile. The half width is the quantile times the root of
/// variance(), but at least min_half_width().
double standard_error(const RandomizedEstimate& estimate);

/// The first (0) or second (1) half of the randomisations, whose number must be even.
RandomizedEstimate half_of(const RandomizedEstimate& estimate, int half);

/// Lower bound on the half width for this number of rays. The scatter does not show an occluder or an opening that no
/// ray hit: N rays all miss a share p of the hemisphere with probability (1 − p)^N ≈ exp(−N·p), which is below 5 % for
/// p > 3/N, and lower for stratified points (the rule of three: Hanley and Lippman-Hand 1983).
double min_half_width(const RandomizedEstimate& estimate);

/// The number of rays that a pixel needs to meet params.tolerance, predicted from its pilot. Rounded up by at most a
/// quarter, so that neighbouring pixels mostly agree.
int rays_needed(const RandomizedEstimate& pilot, const TruthParams& params);

/// The rays of the pilot, which predicts the number of rays and is then discarded.
Randomisations pilot_of(const TruthParams& params);

}  // namespace umbrameter
