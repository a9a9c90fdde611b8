// What a sweep says about the bias: recommended biases and fits. Only for hard shadows, because it needs the causes of
// wrong taps.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compare/bias_curves.h"
#include "compare/bias_formula.h"
#include "compare/bias_plateau.h"
#include "compare/bias_units.h"
#include "core/parameters.h"
#include "core/table.h"

namespace umbrameter {

inline constexpr std::string_view resolution_key = "shadow.resolution";

/// All biases at one combination of the other axes.
struct BiasCurve {
  std::vector<Value> others;  ///< values of the other axes
  BiasOptima optima;
  double depth_unit = 0.0;               ///< mean_depth_unit()
  bool texels_differ = false;            ///< as in BiasAdvice
  BiasFacts facts{};                     ///< known if there are other axes
  std::size_t first_cell = 0;            ///< of the sweep: the one with the first value of each bias
  std::optional<BiasPlateau> plateau{};  ///< along the constant bias, at the slope-scaled bias of least error
  BiasEvidence evidence{};
  std::optional<NoBias> withheld{};  ///< why plateau->recommended is not recommended
  /// Where the axis is too coarse: a bias between these two values of it may have less than half the error of
  /// plateau->least, by least_possible_error().
  std::optional<std::pair<double, double>> coarse{};
};

/// The bias of a BiasLine to which a formula is fitted.
enum class FormulaOf : int { least_error, little_acne, no_acne };
inline constexpr std::array<const char*, 3> formula_names = {"least error", "acne at most 0.1 %", "no acne"};

/// A formula over all axes along which a fact of the bias changes, at one combination of the remaining axes.
struct CurveFormula {
  FormulaOf of = FormulaOf::least_error;
  std::vector<Value> others;            ///< values of BiasCurves::of_a_formula
  std::optional<BiasFormula> formula;   ///< at the slope-scaled bias nearest to 0
  std::vector<FormulaPoint> points;     ///< what it is fitted to
  double slope = 0.0;                   ///< slope-scaled bias of the points, texels
  std::size_t left_out = 0;             ///< combinations of the formula's axes that have no point
  std::size_t distinct = 0;             ///< combinations that differ in what it depends on, with those left out
  std::vector<std::string> warnings{};  ///< why it may be poorly determined: sentences without a full stop
};

struct BiasCurves {
  std::vector<Column> others;  ///< the axes other than biases
  bool varies_constant = false;
  bool varies_slope = false;
  std::vector<BiasCurve> curves;         ///< in the order of cells
  std::vector<Column> formula_axes;      ///< the axes that enter the formulas through the facts that they change
  std::vector<Column> of_a_formula;      ///< the axes other than biases that do not
  std::vector<CurveFormula> formulas;    ///< empty unless the constant bias and such an axis are varied
  std::vector<double> constants;         ///< the axis of constant biases, ascending, in `unit`
  LengthUnit unit = LengthUnit::metres;  ///< of all constant biases
  std::size_t combinations = 0;          ///< number of curves in the sweep; only the first ones are read
};

/// The cell's constant bias in all units.
BiasInUnits in_units(const BiasCurves& curves, const BiasCurve& curve, const BiasCell& cell);

/// "resolution 512, filter nearest".
std::string setting_text(const std::vector<Column>& columns, const std::vector<Value>& values);

/// Value and standard error, rounded to two digits of the latter.
Fitted rounded(const Fitted& fitted);

}  // namespace umbrameter
