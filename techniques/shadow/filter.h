// PCF kernels: which texels a filter reads and what each weighs.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math.h"
#include "techniques/shadow/parameters.h"

namespace umbrameter {

/// Positions and weights of a filter's taps. Grid: the weights are the outer product of `kernel` with itself, centred
/// on the receiver's texel; with linear_taps it is convolved with the bilinear weights, which adds a row and a column.
/// Disk: the texels at `points`, rotated per pixel by one of `rotations`; each has weight 1.
struct FilterKernel {
  /// The position of a bilinear tap is rounded to 1/256 texel, as in graphics hardware (eight bits).
  static constexpr std::uint32_t texel_parts = 256;
  /// Maximum taps along a side of a grid. With the next odd size, the weights of a tent with linear taps overflow 32
  /// bits.
  static constexpr int largest_size = 29;

  std::vector<std::uint32_t> kernel;  ///< of a grid: weights along one side; the size is odd
  bool linear_taps = false;
  std::vector<vec2> points;     ///< of a disk: within the unit disk; empty for a grid
  std::vector<vec2> rotations;  ///< of a disk: cosine and sine
  float radius = 0.0f;          ///< of a disk, texels

  bool is_grid() const { return points.empty(); }
  /// Texels along a side of a grid.
  int side() const { return static_cast<int>(kernel.size()) + (linear_taps ? 1 : 0); }
  int tap_count() const { return is_grid() ? side() * side() : static_cast<int>(points.size()); }
  std::uint32_t weight_sum() const {
    if (!is_grid()) return static_cast<std::uint32_t>(points.size());
    std::uint32_t sum = 0;
    for (const std::uint32_t weight : kernel) sum += weight;
    if (linear_taps) sum *= texel_parts;
    return sum * sum;
  }
};

/// Weight sum of a tent, the kernel with the largest one. Along a side it is ((n + 1)/2)².
constexpr std::uint64_t largest_weight_sum(std::uint64_t size) {
  const std::uint64_t side = (size + 1) / 2 * ((size + 1) / 2) * FilterKernel::texel_parts;
  return side * side;
}
static_assert(largest_weight_sum(FilterKernel::largest_size) < std::uint64_t{1} << 32);

/// Box: equal weights. Tent: 1 2 … 2 1. Gaussian: standard deviation (size + 1) / 6 texels, weights rounded to
/// 1/128 along each side. Bilinear: one linear tap, like `sampler2DShadow` with a linear filter. Poisson:
/// best-candidate samples (D. Mitchell, Spectrally Optimal Sampling for Distribution Ray Tracing, 1991).
FilterKernel make_filter(const PcfParams& params);

}  // namespace umbrameter
