#include "store/fit_bias_formulas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <tuple>

namespace umbrameter {
namespace {

constexpr double min_significance = 2.0;     // standard errors
constexpr double poor_residual_share = 0.1;  // of the RMS bias

bool is_same(double a, double b) {
  return !(std::abs(a - b) > BiasFacts::tolerance * std::max(std::abs(a), std::abs(b)));
}

bool have_same_facts(const BiasCurve& a, const BiasCurve& b) {
  return is_same(a.optima.mean_texel, b.optima.mean_texel) &&
         is_same(a.facts.depth_per_texel, b.facts.depth_per_texel) && is_same(a.facts.radius, b.facts.radius) &&
         is_same(a.facts.depth_step, b.facts.depth_step);
}

// Whether a fact changes along the axis while the other axes stay.
bool changes_a_fact(const BiasCurves& curves, std::size_t axis) {
  for (const BiasCurve& a : curves.curves) {
    for (const BiasCurve& b : curves.curves) {
      if (a.others[axis] == b.others[axis] || have_same_facts(a, b)) continue;
      std::vector<Value> moved = b.others;
      moved[axis] = a.others[axis];
      if (moved == a.others) return true;
    }
  }
  return false;
}

std::vector<Value> select(const std::vector<Value>& values, const std::vector<std::size_t>& indices) {
  std::vector<Value> selected;
  for (const std::size_t i : indices) selected.push_back(values[i]);
  return selected;
}

double rms_bias(const std::vector<FormulaPoint>& points) {
  double squares = 0.0;
  for (const FormulaPoint& point : points) squares += point.bias * point.bias;
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(points.size(), 1)));
}

constexpr std::array<const char*, formula_term_count> term_symbols = {"", "Δz", "r·Δz", "δ"};

// Warnings about the fit itself.
void add_fit_warnings(CurveFormula& of, const BiasFormula& formula) {
  for (const auto& [term, fact, range] :
       {std::tuple{FormulaTerm::slope, "Δz, the depth per texel,", formula.depth_per_texel},
        std::tuple{FormulaTerm::slope_radius, "r, the filter radius,", formula.radius}}) {
    if (!formula.term(term) || range.values != min_formula_values) continue;
    of.warnings.push_back(
        fmt::format("{} takes only {} values: nothing shows whether the bias is linear in it", fact, range.values));
  }
  std::size_t unknowns = 0;
  for (std::size_t t = 0; t < formula_term_count; ++t) {
    const std::optional<Fitted>& fitted = formula.terms[t];
    if (!fitted) continue;
    ++unknowns;
    const bool is_constant = t == static_cast<std::size_t>(FormulaTerm::constant);
    if (is_constant || !(std::abs(fitted->value) < min_significance * fitted->standard_error)) continue;
    of.warnings.push_back(fmt::format("the factor of {}, {:.2g} with a standard error of {:.2g}, may be 0",
                                      term_symbols[t], rounded(*fitted).value, fitted->standard_error));
  }
  for (std::size_t t = 0; t < formula_term_count; ++t) {
    const std::optional<Fitted>& fitted = formula.terms[t];
    const bool is_constant = t == static_cast<std::size_t>(FormulaTerm::constant);
    if (is_constant || !fitted || !(fitted->value < -min_significance * fitted->standard_error)) continue;
    of.warnings.push_back(
        fmt::format("the factor of {} is negative, although a larger {} needs no less bias: these "
                    "points do not show its effect",
                    term_symbols[t], term_symbols[t]));
  }
  if (formula.independent < formula.points) {
    of.warnings.push_back(
        fmt::format("only {} of {} points are independent: those with equal texel size, Δz, filter radius and depth "
                    "step, all that a formula can depend on, count as one",
                    formula.independent, formula.points));
  }
  if (formula.independent < 2 * unknowns) {
    of.warnings.push_back(fmt::format("only {} points for a fit of {} numbers", formula.independent, unknowns));
  }
  const double share = formula.residual / rms_bias(of.points);
  if (formula.residual > formula.axis_step && share > poor_residual_share) {
    of.warnings.push_back(fmt::format(
        "the RMS residual is {:.2g} % of the biases: they depend on more than these axes, or a few pixels decide them; "
        "the formula may be wrong by as much as the largest residual",
        100.0 * share));
  }
}

// The curve's bias at the slope-scaled bias nearest to 0. Empty if there is none, or if it is at an end of the axis
// beyond which it may lie: either end for the least error, the lower end for the least bias with little or no acne.
std::optional<FormulaPoint> point_of(const BiasCurves& curves, const BiasCurve& curve, FormulaOf of) {
  const BiasLine& line = flattest(curve.optima);
  const bool is_least_error = of == FormulaOf::least_error;
  const std::optional<BiasCell>& cell = is_least_error             ? line.least_error
                                        : of == FormulaOf::no_acne ? line.acne_free
                                                                   : line.little_acne;
  if (!cell) return std::nullopt;
  const std::vector<double>& axis = curves.constants;
  const auto place = std::lower_bound(axis.begin(), axis.end(), cell->constant);
  if (place == axis.begin() || (is_least_error && std::next(place) == axis.end())) return std::nullopt;
  // The optimum lies within half an interval on each side, or within the interval below.
  const double step = is_least_error ? 0.5 * (*std::next(place) - *std::prev(place)) : *place - *std::prev(place);
  const double texel = curve.optima.mean_texel;
  const double unit = curves.unit == LengthUnit::metres   ? 1.0
                      : curves.unit == LengthUnit::texels ? texel
                                                          : curve.depth_unit;
  return FormulaPoint{texel, cell->constant * unit, step * unit, curve.facts};
}

struct LeftOut {
  std::vector<Value> values;  ///< of BiasCurves::formula_axes
  FormulaPoint point;
};

// Of these combinations those that differ in what a formula depends on, whether or not they have a bias.
std::size_t count_distinct(const std::vector<FormulaPoint>& with_bias, const std::vector<LeftOut>& left_out) {
  std::vector<FormulaPoint> all = with_bias;
  for (const LeftOut& left : left_out) {
    all.push_back(left.point);
    if (!with_bias.empty()) all.back().step = with_bias.front().step;
  }
  return support_of(all).independent;
}

void add_warnings(const BiasCurves& curves, CurveFormula& of, const std::vector<LeftOut>& left_out) {
  if (curves.curves.size() < curves.combinations) {
    of.warnings.push_back(
        fmt::format("only {} of {} combinations are read: the sweep is too large, or the others count "
                    "no pixels",
                    curves.curves.size(), curves.combinations));
  }
  // Without any point the combinations left out are the reason.
  if (!of.formula && !of.points.empty()) {
    const FormulaSupport support = support_of(of.points);
    of.warnings.push_back(
        fmt::format("not fitted: it needs {} combinations that differ in texel size, Δz, filter radius "
                    "or depth step, and has {}",
                    support.needed, support.independent));
  }
  if (!left_out.empty()) {
    of.warnings.push_back(
        fmt::format("{} of {} combinations are left out, because no bias on the axis qualifies or the best may lie "
                    "beyond an end of it; extend shadow.constant-bias",
                    left_out.size(), left_out.size() + of.points.size()));
  }
  if (!of.formula) return;
  std::vector<Value> first;
  std::size_t outside = 0;
  for (const LeftOut& left : left_out) {
    if (is_outside(*of.formula, left.point) && outside++ == 0) first = left.values;
  }
  if (outside > 0) {
    const std::string one = setting_text(curves.formula_axes, first);
    of.warnings.push_back("of those left out, the formula's range does not reach " +
                          (outside == 1 ? one : fmt::format("{} combinations, one of them {}", outside, one)));
  }
  add_fit_warnings(of, *of.formula);
}

}  // namespace

void add_formulas(BiasCurves& curves) {
  std::vector<std::size_t> in_formula;
  std::vector<std::size_t> rest;
  for (std::size_t a = 0; a < curves.others.size(); ++a) {
    const bool is_in_formula = changes_a_fact(curves, a);
    (is_in_formula ? curves.formula_axes : curves.of_a_formula).push_back(curves.others[a]);
    (is_in_formula ? in_formula : rest).push_back(a);
  }
  if (curves.formula_axes.empty()) return;
  std::vector<std::vector<Value>> settings;
  for (const BiasCurve& curve : curves.curves) {
    std::vector<Value> setting = select(curve.others, rest);
    if (std::ranges::find(settings, setting) == settings.end()) settings.push_back(std::move(setting));
  }
  for (const std::vector<Value>& setting : settings) {
    for (const FormulaOf kind : {FormulaOf::least_error, FormulaOf::little_acne, FormulaOf::no_acne}) {
      CurveFormula of{kind, setting, {}, {}, flattest(curves.curves.front().optima).slope};
      std::vector<LeftOut> left_out;
      for (const BiasCurve& curve : curves.curves) {
        if (select(curve.others, rest) != setting) continue;
        if (const auto point = point_of(curves, curve, kind)) {
          of.points.push_back(*point);
        } else {
          left_out.push_back(
              {select(curve.others, in_formula), {.texel = curve.optima.mean_texel, .facts = curve.facts}});
        }
      }
      of.left_out = left_out.size();
      of.distinct = count_distinct(of.points, left_out);
      of.formula = fit_formula(of.points, kind == FormulaOf::least_error ? AxisRounding::nearest : AxisRounding::up);
      add_warnings(curves, of, left_out);
      curves.formulas.push_back(std::move(of));
    }
  }
}

}  // namespace umbrameter
