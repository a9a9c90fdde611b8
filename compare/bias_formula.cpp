#include "compare/bias_formula.h"

#include <algorithm>
#include <cmath>

#include "compare/least_squares.h"

namespace umbrameter {
namespace {

constexpr double axis_variance = 1.0 / 12.0;  // of a place anywhere within a step of the axis, in steps²

using Fact = double (*)(const FormulaPoint&);
double texel_of(const FormulaPoint& point) { return point.texel; }
double depth_per_texel_of(const FormulaPoint& point) { return point.facts.depth_per_texel; }
double slope_of(const FormulaPoint& point) { return point.facts.depth_per_texel / point.texel; }
double radius_of(const FormulaPoint& point) { return point.facts.radius; }
double depth_step_of(const FormulaPoint& point) { return point.facts.depth_step; }

FormulaRange range_of(std::span<const FormulaPoint> points, Fact fact) {
  std::vector<double> values;
  for (const FormulaPoint& point : points)
    if (std::isfinite(fact(point))) values.push_back(fact(point));
  if (values.empty()) return {};
  std::ranges::sort(values);
  FormulaRange range{values.front(), values.back(), 1};
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] - values[i - 1] > BiasFacts::tolerance * std::abs(values[i])) ++range.values;
  return range;
}

double median_step(std::span<const FormulaPoint> points) {
  std::vector<double> steps;
  for (const FormulaPoint& point : points) steps.push_back(point.step);
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

double length_of(FormulaTerm term, const FormulaPoint& point) {
  switch (term) {
    case FormulaTerm::constant:
      return 1.0;
    case FormulaTerm::slope:
      return point.facts.depth_per_texel;
    case FormulaTerm::slope_radius:
      return point.facts.depth_per_texel * point.facts.radius;
    case FormulaTerm::depth_step:
      return point.facts.depth_step;
  }
  return 0.0;
}

// The terms that the points determine; the others go into `refused`.
std::vector<FormulaTerm> choose_terms(BiasFormula& formula) {
  std::vector<FormulaTerm> used = {FormulaTerm::constant};
  const auto choose = [&](FormulaTerm term, const char* fact, const FormulaRange& range) {
    if (range.values >= min_formula_values) return used.push_back(term);
    formula.refused.push_back(std::string(fact) + " (" + std::to_string(range.values) +
                              (range.values == 1 ? " value" : " values") + "; at least " +
                              std::to_string(min_formula_values) + " are needed)");
  };
  choose(FormulaTerm::slope, "Δz alone", formula.depth_per_texel);
  choose(FormulaTerm::slope_radius, "filter radius", formula.radius);
  const FormulaRange& step = formula.depth_step;
  if (step.values >= min_formula_values && step.max - step.min < formula.axis_step) {
    formula.refused.emplace_back(
        "step of the stored depth (its values differ by less than one step of the bias axis, too little to matter)");
  } else {
    choose(FormulaTerm::depth_step, "step of the stored depth", step);
  }
  return used;
}

bool is_equal(double a, double b) {
  return std::abs(a - b) <= BiasFacts::tolerance * std::max(std::abs(a), std::abs(b));
}

// One point for those that agree in all that the terms depend on, with the mean of their biases: what the formula
// misses there, it misses in each of them, so that they are one observation. Such points differ in an axis that changes
// nothing.
std::vector<FormulaPoint> independent_points(std::span<const FormulaPoint> points, std::span<const FormulaTerm> terms) {
  std::vector<FormulaPoint> independent;
  std::vector<double> merged;  // points in each
  for (const FormulaPoint& point : points) {
    const auto found = std::ranges::find_if(independent, [&](const FormulaPoint& other) {
      return is_equal(point.texel, other.texel) && std::ranges::all_of(terms, [&](FormulaTerm t) {
               return is_equal(length_of(t, point), length_of(t, other));
             });
    });
    if (found == independent.end()) {
      independent.push_back(point);
      merged.push_back(1.0);
      continue;
    }
    double& count = merged[static_cast<std::size_t>(found - independent.begin())];
    count += 1.0;
    found->bias += (point.bias - found->bias) / count;
    found->step += (point.step - found->step) / count;
  }
  return independent;
}

// What is fitted, before it is.
struct Prepared {
  BiasFormula formula;               // without its terms
  std::vector<FormulaPoint> points;  // those whose facts are known
  std::vector<FormulaTerm> terms;    // that they determine
  std::vector<FormulaPoint> fitted;  // the independent ones
};

Prepared prepare(std::span<const FormulaPoint> all) {
  Prepared prepared;
  const auto has_radius = [](const FormulaPoint& point) { return std::isfinite(point.facts.radius); };
  const bool needs_radius = std::ranges::any_of(all, has_radius);
  std::vector<FormulaPoint>& points = prepared.points;
  for (const FormulaPoint& point : all) {
    if (std::isfinite(point.facts.depth_per_texel) && (!needs_radius || has_radius(point))) points.push_back(point);
  }
  BiasFormula& formula = prepared.formula;
  formula.points = points.size();
  formula.axis_step = median_step(points);
  formula.texel = range_of(points, texel_of);
  formula.depth_per_texel = range_of(points, depth_per_texel_of);
  formula.slope = range_of(points, slope_of);
  formula.radius = range_of(points, radius_of);
  formula.depth_step = range_of(points, depth_step_of);
  prepared.terms = choose_terms(formula);
  prepared.fitted = independent_points(points, prepared.terms);
  formula.independent = prepared.fitted.size();
  return prepared;
}

std::size_t needed_points(const Prepared& prepared) { return std::max<std::size_t>(prepared.terms.size(), 2) + 1; }

bool is_within(const FormulaRange& range, double value) {
  const double margin = BiasFacts::tolerance * std::max(std::abs(range.min), std::abs(range.max));
  return value >= range.min - margin && value <= range.max + margin;
}

}  // namespace

double bias_of(const BiasFormula& formula, const FormulaPoint& point) {
  double bias = 0.0;
  for (std::size_t t = 0; t < formula_term_count; ++t) {
    if (formula.terms[t]) bias += formula.terms[t]->value * length_of(static_cast<FormulaTerm>(t), point);
  }
  return bias;
}

bool is_outside(const BiasFormula& formula, const FormulaPoint& point) {
  const bool uses_slope = formula.term(FormulaTerm::slope) || formula.term(FormulaTerm::slope_radius);
  return (uses_slope && !is_within(formula.depth_per_texel, point.facts.depth_per_texel)) ||
         (formula.term(FormulaTerm::slope_radius) && !is_within(formula.radius, point.facts.radius)) ||
         (formula.term(FormulaTerm::depth_step) && !is_within(formula.depth_step, point.facts.depth_step));
}

FormulaSupport support_of(std::span<const FormulaPoint> points) {
  const Prepared prepared = prepare(points);
  return {prepared.fitted.size(), needed_points(prepared)};
}

std::optional<BiasFormula> fit_formula(std::span<const FormulaPoint> all, AxisRounding rounding) {
  Prepared prepared = prepare(all);
  if (prepared.fitted.size() < needed_points(prepared) || prepared.terms.size() < 2) return std::nullopt;
  const std::vector<FormulaPoint>& points = prepared.points;
  const std::vector<FormulaTerm>& terms = prepared.terms;
  const std::vector<FormulaPoint>& fitted = prepared.fitted;
  const std::size_t count = terms.size();
  BiasFormula& formula = prepared.formula;
  std::vector<LeastSquaresRow> rows;
  std::vector<double> right;
  for (const FormulaPoint& point : fitted) {
    LeastSquaresRow& row = rows.emplace_back();
    for (std::size_t t = 0; t < count; ++t) row[t] = length_of(terms[t], point) / point.step;
    right.push_back(point.bias / point.step);
  }
  const std::optional<LeastSquares> solved = solve_least_squares(rows, right, count);
  if (!solved) return std::nullopt;
  double squares = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) squares += std::pow(solved->predict(rows[i], count) - right[i], 2);
  const double variance = std::max(squares / static_cast<double>(fitted.size() - count), axis_variance);
  // What each term becomes if every bias is a step larger. The RMS of a rounding is 1/√12 of a step, upwards 1/√3.
  const std::optional<LeastSquares> step = solve_least_squares(rows, std::vector<double>(rows.size(), 1.0), count);
  const double rounding_variance = rounding == AxisRounding::up ? 4.0 * axis_variance : axis_variance;
  for (std::size_t t = 0; t < count; ++t) {
    const double of_scatter = std::max(solved->covariance[t][t], 0.0) * variance;
    const double of_rounding = rounding_variance * step->value[t] * step->value[t];
    formula.terms[static_cast<std::size_t>(terms[t])] = Fitted{solved->value[t], std::sqrt(of_scatter + of_rounding)};
  }
  for (const FormulaPoint& point : points) {
    const double residual = std::abs(point.bias - bias_of(formula, point));
    formula.residual += residual * residual;
    formula.residual_texels += residual * residual / (point.texel * point.texel);
    formula.worst_residual = std::max(formula.worst_residual, residual);
  }
  const auto size = static_cast<double>(points.size());
  formula.residual = std::sqrt(formula.residual / size);
  formula.residual_texels = std::sqrt(formula.residual_texels / size);
  return formula;
}

}  // namespace umbrameter
