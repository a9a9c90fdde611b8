// The variance of any statistic, from its values without parts of the data.
#pragma once

#include <span>

namespace umbrameter {

/// Variance of a value from what it is without each of B groups of the data: (B − 1)/B Σ (θ_b − mean)². Groups may be
/// of different sizes. Delete-a-group jackknife (Quenouille 1956; Kott 2001).
inline double jackknife_variance(std::span<const double> without) {
  const auto groups = static_cast<double>(without.size());
  double mean = 0.0;
  for (const double each : without) mean += each / groups;
  double squares = 0.0;
  for (const double each : without) squares += (each - mean) * (each - mean);
  return (groups - 1.0) / groups * squares;
}

}  // namespace umbrameter
