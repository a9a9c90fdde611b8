// Sums over the points of a pixel that differ in weight, and the estimate that they give. For raytrace/*.cpp alone.
#pragma once

#include <algorithm>
#include <array>

#include "raytrace/adaptive_sampling.h"

namespace umbrameter {

/// Sums of the weights of one randomisation's points.
struct WeightedSums {
  double lit = 0.0;
  double all = 0.0;
  double squares = 0.0;  ///< of squared weights
};
using AllWeightedSums = std::array<WeightedSums, max_randomisations>;

/// Adds the randomisations from `first` to `last` to an estimate with equal weights: the ratio lit / all, with its
/// scatter by the delta method (Cochran, Sampling Techniques, 1977, section 6.4). The effective sample size of points
/// with unequal weights is (Σ w)²/Σ w² (Kish, Survey Sampling, 1965, section 11.7). With weights of 1 nothing changes.
inline void add_randomisations(RandomizedEstimate& estimate, const AllWeightedSums& sums, int first, int last) {
  WeightedSums total;
  int points = 0;
  for (int r = first; r < last; ++r) {
    const WeightedSums& s = sums[static_cast<std::size_t>(r)];
    total.lit += s.lit;
    total.all += s.all;
    total.squares += s.squares;
    points += estimate.split.size(r);
  }
  const double share = total.lit / total.all;
  for (int r = first; r < last; ++r) {
    const WeightedSums& s = sums[static_cast<std::size_t>(r)];
    estimate.open[static_cast<std::size_t>(r)] =
        share * estimate.split.size(r) + (s.lit - share * s.all) * points / total.all;
  }
  estimate.effective_share = std::min(estimate.effective_share, total.all * total.all / (points * total.squares));
}

/// Takes the points of next() into account. Returns whether more are needed.
inline bool advance(AdaptiveSampleCount& sample_count, AllWeightedSums& sums, const TruthParams& params) {
  RandomizedEstimate estimate;
  estimate.split = sample_count.next().split;
  const int count = estimate.split.count;
  if (params.tolerance > 0.0) {  // the halves must be independent
    add_randomisations(estimate, sums, 0, count / 2);
    add_randomisations(estimate, sums, count / 2, count);
  } else {
    add_randomisations(estimate, sums, 0, count);
  }
  const bool was_pilot = sample_count.is_pilot();
  const bool goes_on = sample_count.advance(params, estimate);
  if (was_pilot) sums = {};
  return goes_on;
}

}  // namespace umbrameter
