// Linear least squares with a few unknowns.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace umbrameter {

inline constexpr std::size_t max_coefficients = 5;
using LeastSquaresRow = std::array<double, max_coefficients>;

struct LeastSquares {
  LeastSquaresRow value{};
  std::array<LeastSquaresRow, max_coefficients> covariance{};  ///< for residuals of variance 1

  /// Sum of the row's values times the first `count` unknowns.
  double predict(const LeastSquaresRow& row, std::size_t count) const;
};

/// The unknowns whose sums over the first `count` values of each row are nearest to `right`. Weighted if rows and right
/// sides are multiplied by the square roots of the weights. Nothing where the columns depend on one another.
std::optional<LeastSquares> solve_least_squares(const std::vector<LeastSquaresRow>& rows,
                                                const std::vector<double>& right, std::size_t count);

}  // namespace umbrameter
