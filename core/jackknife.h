// The variance of any statistic, from its values without parts of the data.
#pragma once

#include <algorithm>
#include <span>

namespace umbrameter {

/// A variance, and how well it is known.
struct JackknifeVariance {
  double variance = 0.0;
  double degrees_of_freedom = 0.0;
};

/// Of a value from what it is without each of B groups of the data: (B − 1)/B Σ d_b², d_b = θ_b − mean. Groups may be
/// of different sizes. Delete-a-group jackknife (Quenouille 1956; Kott 2001).
///
/// Each d_b² has one degree of freedom and a mean σ_b², so that the sum has (Σ σ_b²)² / Σ σ_b⁴ (Satterthwaite 1946),
/// where E d_b⁴ = 3σ_b⁴ of the normal distribution; at most B − 1. That is few where few groups decide.
inline JackknifeVariance jackknife_variance(std::span<const double> without) {
  const auto groups = static_cast<double>(without.size());
  double mean = 0.0;
  for (const double each : without) mean += each / groups;
  double squares = 0.0;
  double fourth_powers = 0.0;
  for (const double each : without) {
    const double square = (each - mean) * (each - mean);
    squares += square;
    fourth_powers += square * square;
  }
  const double effective = fourth_powers > 0.0 ? 3.0 * squares * squares / fourth_powers : groups;
  return {(groups - 1.0) / groups * squares, std::min(effective, groups - 1.0)};
}

}  // namespace umbrameter
