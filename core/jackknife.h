// The variance of any statistic, from its values without parts of the data.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace umbrameter {

/// A variance, and how well it is known.
struct JackknifeVariance {
  double variance = 0.0;
  double degrees_of_freedom = 0.0;
};

/// A block of an image's pixels on the grid of blocks.
struct BlockPlace {
  int column = 0;
  int row = 0;
};

/// With fewer blocks, the variance over them is too uncertain for an interval.
inline constexpr std::size_t fewest_blocks = 20;

/// Of a value from what it is without each of B blocks of the data: with d_b = θ_b − mean, Σ d_b², scaled so that its
/// mean is that of the jackknife (B − 1)/B Σ σ_b². Blocks may be of different sizes. Delete-a-group jackknife
/// (Quenouille 1956; Kott 2001).
///
/// `places` are those of the blocks of an image; empty if the groups are independent. What an image shows goes on from
/// one block to the next, so that neighbours err alike. The sum then has Σ w_bc d_b d_c, where w falls linearly to 0
/// over two blocks along both axes: 1 of a block itself, ½ beside it, ¼ across a corner (Conley 1999; Bartlett's
/// weights, with which no variance is negative). Of independent blocks it has the same mean.
///
/// Each d_b² has one degree of freedom and a mean σ_b², so that the sum has (Σ σ_b²)² / Σ σ_b⁴ (Satterthwaite 1946),
/// where E d_b⁴ = 3σ_b⁴ of the normal distribution; at most B − 1. That is few where few blocks decide. The products
/// with neighbours add to the scatter of the sum: it has Σ w_bc² / B times the variance.
inline JackknifeVariance jackknife_variance(std::span<const double> without, std::span<const BlockPlace> places = {}) {
  const auto blocks = static_cast<double>(without.size());
  double mean = 0.0;
  for (const double each : without) mean += each / blocks;
  double squares = 0.0;
  double fourth_powers = 0.0;
  double products = 0.0;
  double weights = 0.0;         // Σ w / B
  double weight_squares = 0.0;  // Σ w² / B
  for (std::size_t b = 0; b < without.size(); ++b) {
    const double d = without[b] - mean;
    squares += d * d;
    fourth_powers += d * d * d * d;
    for (std::size_t c = 0; c < places.size(); ++c) {
      const int columns = std::abs(places[b].column - places[c].column);
      const int rows = std::abs(places[b].row - places[c].row);
      if (columns > 1 || rows > 1) continue;
      const double weight = (1.0 - 0.5 * columns) * (1.0 - 0.5 * rows);
      products += weight * d * (without[c] - mean);
      weights += weight / blocks;
      weight_squares += weight * weight / blocks;
    }
  }
  const double effective =
      std::min(fourth_powers > 0.0 ? 3.0 * squares * squares / fourth_powers : blocks, blocks - 1.0);
  // In a grid so small that all blocks are neighbours, nothing is known of how alike they are.
  if (places.empty() || weights > 0.25 * blocks) return {(blocks - 1.0) / blocks * squares, effective};
  const double scale = (blocks - 1.0) / (blocks - weights);
  return {scale * (blocks - 1.0) / blocks * products, std::max(effective / weight_squares, 1.0)};
}

}  // namespace umbrameter
