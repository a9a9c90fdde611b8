// One formula for the bias over several axes: the size of texels, the angle of the light, the radius of the filter and
// the steps of the stored depth.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/bias_law.h"

namespace umbrameter {

/// What the bias of one configuration may depend on.
struct BiasFacts {
  double tangent = std::numeric_limits<double>::quiet_NaN();  ///< tan θ that 90 % of the counted pixels do not exceed
  double radius = std::numeric_limits<double>::quiet_NaN();  ///< of the filter, from its centre to its last tap, texels
  double depth_step = 0.0;                                   ///< mean step of the stored depth at the receivers, metres
};

/// A bias of one configuration, and its facts.
struct FormulaPoint {
  FitPoint fit;
  BiasFacts facts;
};

/// The terms of the formula, each with its factor: a length in metres times an unknown.
enum class FormulaTerm : int { constant, slope, slope_radius, depth_step };
inline constexpr std::size_t formula_term_count = 4;

/// bias ≈ c0 + a·texel·tan θ·(1 + b·radius) + q·step, at a slope-scaled bias of 0. Unknowns of terms that do not vary
/// enough are absent.
struct BiasFormula {
  std::size_t points = 0;
  /// Of the term's length: c0 in metres, a, a·b per texel, q. Empty where the term was refused.
  std::array<std::optional<Fitted>, formula_term_count> terms{};
  std::optional<Fitted> per_radius{};  ///< b, 1/texels; its standard error to first order
  std::vector<std::string> refused{};  ///< why terms are absent: "filter radius: 2 values, at least 3 are needed"
  double residual = 0.0;               ///< RMS, metres
  double residual_texels = 0.0;        ///< RMS, in units of each point's texel
  double worst_residual = 0.0;         ///< largest, metres
};

/// The bias that the formula gives, metres.
double bias_of(const BiasFormula& formula, const FormulaPoint& point);

/// Number of different values that an axis must have for its term.
inline constexpr std::size_t min_formula_values = 3;

/// Least squares with each point weighted by 1/step². The size of texels times tan θ must take at least
/// min_formula_values values, the radius as well, or their terms are refused; the depth step, two. Points of which a
/// fact is NaN are left out. Empty without a term besides c0, or with no more points than unknowns.
std::optional<BiasFormula> fit_formula(std::span<const FormulaPoint> points);

}  // namespace umbrameter
