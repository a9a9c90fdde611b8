#include "compare/least_squares.h"

#include <algorithm>
#include <cmath>

namespace umbrameter {
namespace {

// A column of which less than this share remains after orthogonalization depends on the columns before it.
constexpr double min_independent_share = 1e-9;

double inner(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

double LeastSquares::predict(const LeastSquaresRow& row, std::size_t count) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += row[i] * value[i];
  return sum;
}

// Modified Gram-Schmidt: Björck, Solving linear least squares problems by Gram-Schmidt orthogonalization, BIT 7, 1967.
std::optional<LeastSquares> solve_least_squares(const std::vector<LeastSquaresRow>& rows,
                                                const std::vector<double>& right, std::size_t count) {
  std::array<std::vector<double>, max_coefficients> q;
  std::array<LeastSquaresRow, max_coefficients> r{};
  LeastSquaresRow projected{};
  std::vector<double> rest = right;
  for (std::size_t j = 0; j < count; ++j) {
    for (const LeastSquaresRow& row : rows) q[j].push_back(row[j]);
  }
  for (std::size_t j = 0; j < count; ++j) {
    const double whole = std::sqrt(inner(q[j], q[j]));
    for (std::size_t k = 0; k < j; ++k) {
      r[k][j] = inner(q[k], q[j]);
      for (std::size_t i = 0; i < rows.size(); ++i) q[j][i] -= r[k][j] * q[k][i];
    }
    r[j][j] = std::sqrt(inner(q[j], q[j]));
    if (!(r[j][j] > min_independent_share * whole)) return std::nullopt;
    for (double& value : q[j]) value /= r[j][j];
    projected[j] = inner(q[j], rest);
    for (std::size_t i = 0; i < rows.size(); ++i) rest[i] -= projected[j] * q[j][i];
  }
  LeastSquares solution;
  std::array<LeastSquaresRow, max_coefficients> inverse{};  // of r, upper triangular
  for (std::size_t column = 0; column < count; ++column) {
    for (std::size_t row = column + 1; row-- > 0;) {
      double value = row == column ? 1.0 : 0.0;
      for (std::size_t k = row + 1; k <= column; ++k) value -= r[row][k] * inverse[k][column];
      inverse[row][column] = value / r[row][row];
    }
  }
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t k = a; k < count; ++k) solution.value[a] += inverse[a][k] * projected[k];
    for (std::size_t b = 0; b < count; ++b) {
      for (std::size_t k = std::max(a, b); k < count; ++k) {
        solution.covariance[a][b] += inverse[a][k] * inverse[b][k];
      }
    }
  }
  return solution;
}

}  // namespace umbrameter
