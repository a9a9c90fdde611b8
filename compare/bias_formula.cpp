#include "compare/bias_formula.h"

#include <algorithm>
#include <cmath>

#include "compare/least_squares.h"

namespace umbrameter {
namespace {

constexpr std::size_t min_depth_steps = 2;
constexpr double min_radius_share = 0.05;  // of a, below which a·b / a is noise

// Values that differ by less than a thousandth count once.
std::size_t count_values(std::span<const FormulaPoint> points, double (*value)(const FormulaPoint&)) {
  std::vector<double> values;
  for (const FormulaPoint& point : points) values.push_back(value(point));
  std::sort(values.begin(), values.end());
  std::size_t count = values.empty() ? 0 : 1;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] - values[i - 1] > 1e-3 * std::abs(values[i])) ++count;
  return count;
}

double length_of(FormulaTerm term, const FormulaPoint& point) {
  const double slope = point.fit.texel * point.facts.tangent;
  switch (term) {
    case FormulaTerm::constant:
      return 1.0;
    case FormulaTerm::slope:
      return slope;
    case FormulaTerm::slope_radius:
      return slope * point.facts.radius;
    case FormulaTerm::depth_step:
      return point.facts.depth_step;
  }
  return 0.0;
}

std::string refusal(const char* axis, std::size_t values, std::size_t needed) {
  return std::string(axis) + ": " + std::to_string(values) + (values == 1 ? " value" : " values") + ", at least " +
         std::to_string(needed) + " are needed";
}

struct Terms {
  std::vector<FormulaTerm> used = {FormulaTerm::constant};
  std::vector<std::string> refused;
};

Terms choose_terms(std::span<const FormulaPoint> points) {
  Terms terms;
  const auto choose = [&](FormulaTerm term, const char* axis, std::size_t needed,
                          double (*value)(const FormulaPoint&)) {
    const std::size_t values = count_values(points, value);
    if (values >= needed) {
      terms.used.push_back(term);
    } else {
      terms.refused.push_back(refusal(axis, values, needed));
    }
  };
  choose(FormulaTerm::slope, "texel size times tan θ", min_formula_values,
         [](const FormulaPoint& p) { return p.fit.texel * p.facts.tangent; });
  choose(FormulaTerm::slope_radius, "filter radius", min_formula_values,
         [](const FormulaPoint& p) { return p.facts.radius; });
  choose(FormulaTerm::depth_step, "step of the stored depth", min_depth_steps,
         [](const FormulaPoint& p) { return p.facts.depth_step; });
  return terms;
}

}  // namespace

double bias_of(const BiasFormula& formula, const FormulaPoint& point) {
  double bias = 0.0;
  for (std::size_t t = 0; t < formula_term_count; ++t) {
    if (formula.terms[t]) bias += formula.terms[t]->value * length_of(static_cast<FormulaTerm>(t), point);
  }
  return bias;
}

std::optional<BiasFormula> fit_formula(std::span<const FormulaPoint> all) {
  std::vector<FormulaPoint> points;
  for (const FormulaPoint& point : all) {
    if (std::isfinite(point.facts.tangent) && std::isfinite(point.facts.radius)) points.push_back(point);
  }
  const Terms terms = choose_terms(points);
  const std::size_t count = terms.used.size();
  if (count < 2 || points.size() <= count) return std::nullopt;
  std::vector<LeastSquaresRow> rows;
  std::vector<double> right;
  for (const FormulaPoint& point : points) {
    LeastSquaresRow& row = rows.emplace_back();
    for (std::size_t t = 0; t < count; ++t) row[t] = length_of(terms.used[t], point) / point.fit.step;
    right.push_back(point.fit.bias / point.fit.step);
  }
  const std::optional<LeastSquares> solved = solve_least_squares(rows, right, count);
  if (!solved) return std::nullopt;
  double squares = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) squares += std::pow(solved->predict(rows[i], count) - right[i], 2);
  const double variance = squares / static_cast<double>(points.size() - count);

  BiasFormula formula;
  formula.points = points.size();
  formula.refused = terms.refused;
  for (std::size_t t = 0; t < count; ++t) {
    formula.terms[static_cast<std::size_t>(terms.used[t])] =
        Fitted{solved->value[t], std::sqrt(std::max(solved->covariance[t][t], 0.0) * variance)};
  }
  const std::optional<Fitted>& slope = formula.terms[static_cast<std::size_t>(FormulaTerm::slope)];
  const std::optional<Fitted>& radius = formula.terms[static_cast<std::size_t>(FormulaTerm::slope_radius)];
  if (slope && radius && std::abs(slope->value) > min_radius_share * std::abs(radius->value)) {
    // The slope's term is the second and the radius's the third of those that are used.
    const auto& covariance = solved->covariance;
    const double b = radius->value / slope->value;
    const double relative = covariance[2][2] + b * b * covariance[1][1] - 2.0 * b * covariance[1][2];
    formula.per_radius = Fitted{b, std::sqrt(std::max(relative, 0.0) * variance) / std::abs(slope->value)};
  }
  for (const FormulaPoint& point : points) {
    const double residual = std::abs(point.fit.bias - bias_of(formula, point));
    formula.residual += residual * residual;
    formula.residual_texels += residual * residual / (point.fit.texel * point.fit.texel);
    formula.worst_residual = std::max(formula.worst_residual, residual);
  }
  const auto size = static_cast<double>(points.size());
  formula.residual = std::sqrt(formula.residual / size);
  formula.residual_texels = std::sqrt(formula.residual_texels / size);
  return formula;
}

}  // namespace umbrameter
