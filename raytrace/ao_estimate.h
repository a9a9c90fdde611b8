// From the rays of a pixel to its accessibility, its interval and the number of rays that it still needs.
// For raytrace/*.cpp and tests.
#pragma once

#include <array>

#include "raytrace/parameters.h"
#include "raytrace/sampler.h"

namespace umbrameter {

/// How open the rays of each randomisation were. Of uneven weights those that would say the same by even ones.
struct AoEstimate {
  Randomisations split{1, 0};
  double worth = 1.0;                              ///< of one point, in even ones
  std::array<double, most_randomisations> open{};  ///< sum of 1 − occlusion over the randomisation's rays

  double mean() const;
  /// Unbiased estimate of the mean's variance, from the scatter of the randomisations' means. 0 where they agree.
  double variance() const;
};

/// Half width of the interval about the mean that holds the true accessibility in 95 % of cases, over Student's t
/// quantile, which a reader multiplies by it. The half width is the quantile times the root of variance(), and never
/// below least_half_width().
double standard_error(const AoEstimate& estimate);

/// Half 0 or 1 of its randomisations, whose number must be even.
AoEstimate half_of(const AoEstimate& estimate, int half);

/// The least half width that this many points can claim. An occluder too small to be met, or an opening, is not in the
/// scatter: N rays that miss a share p of the hemisphere do so with probability (1 − p)^N ≈ exp(−N·p), below 5 % from
/// p = 3/N on, and stratified points less often (the rule of three: Hanley and Lippman-Hand 1983).
double least_half_width(const AoEstimate& estimate);

/// How many rays a pixel's estimate needs to meet params.tolerance, judged from what another estimate has shown.
/// In steps of up to a quarter, so that neighbours mostly agree.
int rays_needed(const AoEstimate& seen, const TruthParams& params);

/// Rays of the pilot, which decides how many follow and is then left out of the estimate.
Randomisations pilot_of(const TruthParams& params);

}  // namespace umbrameter
