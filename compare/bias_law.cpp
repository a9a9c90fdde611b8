#include "compare/bias_law.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "compare/least_squares.h"

namespace umbrameter {
namespace {

// A surface with a smaller tan θ counts as perpendicular to the light.
constexpr double min_tangent = 1e-6;

std::optional<FitPoint> point_at(const BiasCell& cell, double texel, std::span<const double> axis, bool two_sided) {
  const auto place = std::lower_bound(axis.begin(), axis.end(), cell.constant);
  if (place == axis.end() || *place != cell.constant || place == axis.begin()) return std::nullopt;
  if (two_sided && std::next(place) == axis.end()) return std::nullopt;
  // The optimum lies within half an interval on each side, or within the interval below.
  const double step = two_sided ? 0.5 * (*std::next(place) - *std::prev(place)) : *place - *std::prev(place);
  return FitPoint{texel, cell.slope, cell.constant, step};
}

// The points, split at the bend s = c1. Before the bend the required bias falls with s; after it the bias stays at c0.
struct Bend {
  std::span<const FitPoint> points;  ///< in ascending order of the slope-scaled bias
  std::size_t sloping = 0;           ///< number of points before the bend
  std::size_t slopes = 0;            ///< number of different slope-scaled biases before the bend
};

struct Fit {
  Bend bend;
  LeastSquares solution;
  std::size_t coefficients = 0;
  double squares = 0.0;  ///< weighted sum of squared residuals
};

double slope_factor(const Fit& fit) {
  return fit.bend.points.front().slope + fit.solution.value[1] / fit.solution.value[2];
}

// Points at the same texel size and slope-scaled bias count once.
std::size_t count_different(std::span<const FitPoint> points) {
  std::set<std::pair<double, double>> places;
  for (const FitPoint& point : points) places.emplace(point.texel, point.slope);
  return places.size();
}

std::optional<Fit> fit_bend(const Bend& bend) {
  const auto sloping = bend.points.first(bend.sloping);
  const auto texel_differs = [&](const FitPoint& point) { return point.texel != sloping.front().texel; };
  if (std::none_of(sloping.begin(), sloping.end(), texel_differs)) return std::nullopt;
  Fit fit{bend, {}, bend.slopes > 1 ? std::size_t{3} : std::size_t{2}};
  // Points that repeat one another determine nothing, and those that a fit passes through do not support it.
  if (count_different(bend.points) <= fit.coefficients) return std::nullopt;
  const double first = bend.points.front().slope;
  std::vector<LeastSquaresRow> rows;
  std::vector<double> right;
  for (std::size_t i = 0; i < bend.points.size(); ++i) {
    const FitPoint& point = bend.points[i];
    const double weight = 1.0 / point.step;
    const double texel = i < bend.sloping ? point.texel : 0.0;
    rows.push_back({weight, weight * texel, -weight * (point.slope - first) * texel});
    right.push_back(weight * point.bias);
  }
  const std::optional<LeastSquares> solution = solve_least_squares(rows, right, fit.coefficients);
  if (!solution) return std::nullopt;
  fit.solution = *solution;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double residual = fit.solution.predict(rows[i], fit.coefficients) - right[i];
    fit.squares += residual * residual;
  }
  if (fit.coefficients < 3) return fit;
  // Before the bend, slope-scaled biases must not exceed c1. Without a tangent there is no c1, and no bend.
  const bool is_flat = !(fit.solution.value[2] > min_tangent);
  const bool has_bend = bend.sloping < bend.points.size();
  if (is_flat ? has_bend : slope_factor(fit) < sloping.back().slope) return std::nullopt;
  return fit;
}

}  // namespace

std::optional<FitPoint> point_of_least_error(const BiasCell& cell, double texel, std::span<const double> axis) {
  return point_at(cell, texel, axis, true);
}

std::optional<FitPoint> point_of_least_free(const BiasCell& cell, double texel, std::span<const double> axis) {
  return point_at(cell, texel, axis, false);
}

double bias_of(const BiasFit& law, double texel, double slope) {
  if (slope >= law.flat_from) return law.constant.value;
  const double tangent = law.tangent ? law.tangent->value : 0.0;
  return law.constant.value + (law.per_texel.value - tangent * (slope - law.first_slope)) * texel;
}

std::optional<BiasFit> fit_law(std::span<const FitPoint> points) {
  std::vector<FitPoint> sorted(points.begin(), points.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const FitPoint& a, const FitPoint& b) { return a.slope < b.slope; });
  std::optional<Fit> best;
  Bend bend{sorted};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i + 1 < sorted.size() && sorted[i + 1].slope == sorted[i].slope) continue;
    bend.sloping = i + 1;
    ++bend.slopes;
    const std::optional<Fit> fit = fit_bend(bend);
    if (fit && (!best || fit->squares <= best->squares)) best = fit;
  }
  if (!best) return std::nullopt;

  const LeastSquares& solution = best->solution;
  BiasFit law;
  law.points = sorted.size();
  law.first_slope = sorted.front().slope;
  law.constant.value = solution.value[0];
  law.per_texel.value = solution.value[1];
  if (best->coefficients == 3) law.tangent = Fitted{solution.value[2], {}};
  if (best->bend.sloping < sorted.size()) law.flat_from = sorted[best->bend.sloping].slope;
  for (const FitPoint& point : sorted) {
    const double residual = point.bias - bias_of(law, point.texel, point.slope);
    law.residual += residual * residual;
    law.residual_texels += residual * residual / (point.texel * point.texel);
  }
  const auto size = static_cast<double>(sorted.size());
  law.residual = std::sqrt(law.residual / size);
  law.residual_texels = std::sqrt(law.residual_texels / size);

  const double variance = best->squares / static_cast<double>(sorted.size() - best->coefficients);
  const auto& covariance = solution.covariance;
  const auto error = [&](double unit_variance) { return std::sqrt(std::max(unit_variance, 0.0) * variance); };
  law.constant.standard_error = error(covariance[0][0]);
  law.per_texel.standard_error = error(covariance[1][1]);
  if (law.tangent) {
    law.tangent->standard_error = error(covariance[2][2]);
    // Without a tangent c1 is undefined. Its standard error is propagated to first order.
    if (const double tangent = law.tangent->value; tangent > min_tangent) {
      const double ratio = law.per_texel.value / tangent;
      law.slope_factor =
          Fitted{law.first_slope + ratio,
                 error((covariance[1][1] + ratio * ratio * covariance[2][2] - 2.0 * ratio * covariance[1][2]) /
                       (tangent * tangent))};
    }
  }
  return law;
}

}  // namespace umbrameter
