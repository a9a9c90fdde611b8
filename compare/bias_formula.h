// One formula for the bias over several axes: the resolution and the angle of the light, which change the depth per
// texel, the radius of the filter, and the format of the stored depth.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/bias_facts.h"

namespace umbrameter {

/// A bias of one configuration on a sweep axis, known to within one step of that axis, and its facts.
struct FormulaPoint {
  double texel = 0.0;  ///< mean side of a texel, metres
  double bias = 0.0;   ///< constant bias, metres
  double step = 1.0;   ///< width of the interval between axis values that contains the bias, metres
  BiasFacts facts{};
};

struct Fitted {
  double value = 0.0;
  double standard_error = 0.0;
};

/// The terms of the formula, each with its factor: a length in metres times an unknown.
enum class FormulaTerm : int { constant, slope, slope_radius, depth_step };
inline constexpr std::size_t formula_term_count = 4;

/// What the points' facts cover.
struct FormulaRange {
  double min = 0.0;
  double max = 0.0;
  std::size_t values = 0;  ///< number of different values; those that differ by less than a thousandth count once
};

/// bias ≈ c0 + (a + b·radius)·Δz + q·step, where Δz is BiasFacts::depth_per_texel. Unknowns of terms that the points do
/// not determine are absent.
struct BiasFormula {
  std::size_t points = 0;
  std::size_t independent = 0;  ///< those that differ in what the terms depend on; only they count in the fit
  /// Of the term's length: c0 in metres, a, b per texel, q. Empty where the term was refused.
  std::array<std::optional<Fitted>, formula_term_count> terms{};
  std::vector<std::string> refused{};  ///< why terms are absent: "filter radius: 1 value, at least 2 are needed"
  double residual = 0.0;               ///< RMS, metres
  double residual_texels = 0.0;        ///< RMS, in units of each point's texel
  double worst_residual = 0.0;         ///< largest, metres
  double axis_step = 0.0;              ///< median of FormulaPoint::step, metres
  FormulaRange texel;                  ///< mean side of a texel, metres
  FormulaRange depth_per_texel;        ///< metres
  FormulaRange slope;                  ///< the same in units of each point's texel
  FormulaRange radius;                 ///< texels; no values where a search finds the radius of each pixel
  FormulaRange depth_step;             ///< metres

  const std::optional<Fitted>& term(FormulaTerm which) const { return terms[static_cast<std::size_t>(which)]; }
};

/// The bias that the formula gives, metres.
double bias_of(const BiasFormula& formula, const FormulaPoint& point);

/// Whether a point's facts lie outside those that the formula was fitted to, so that its bias is an extrapolation. A
/// fact whose term is absent does not count.
bool is_outside(const BiasFormula& formula, const FormulaPoint& point);

/// Number of different values that an axis must have for its term. With as few, nothing shows whether the bias is
/// linear in it.
inline constexpr std::size_t min_formula_values = 2;

/// How many independent points there are, and how many fit_formula() needs at least.
struct FormulaSupport {
  std::size_t independent = 0;
  std::size_t needed = 0;
};
FormulaSupport support_of(std::span<const FormulaPoint> points);

/// How the axis rounds a bias: to the nearest of its values, or up to the next.
enum class AxisRounding { nearest, up };

/// Least squares with each point weighted by 1/step². Points that agree in all that the terms depend on count as one,
/// their mean. Terms whose fact takes fewer than min_formula_values values are
/// refused, as is that of the depth step if its values differ by less than the median step of the bias axis. Standard
/// errors come from the scatter, which counts as no less than that of biases anywhere within their step, and from the
/// rounding to the axis, which counts as the same share of a step at every point: on an axis in texels it is, where
/// only the resolution varies, and more points do not average it out. Points are left out whose depth per texel is not
/// finite, and those whose radius is not known, unless no point's is. Empty without a term besides c0, or with no more
/// independent points than unknowns.
std::optional<BiasFormula> fit_formula(std::span<const FormulaPoint> points,
                                       AxisRounding rounding = AxisRounding::nearest);

}  // namespace umbrameter
