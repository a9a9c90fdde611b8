// What a sweep says about the bias: read from its rows one by one, told in tables, lines, figures and summary.json.
// Only for hard shadows: it asks for the causes of wrong taps.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/bias_curves.h"
#include "compare/bias_law.h"
#include "compare/bias_units.h"
#include "experiments/presentation/presentation.h"
#include "experiments/sweep_results.h"

namespace umbrameter {

/// All biases at one combination of the other axes.
struct BiasCurve {
  std::vector<Value> others;  ///< values of the other axes
  BiasOptima optima;
  double depth_range = 0.0;  ///< of the map, metres
};

/// Biases of a line that laws are fitted to.
enum class LawOf : int { least_error, little_acne, no_acne };
inline constexpr std::array<const char*, 3> law_names = {"least error", "acne at most 0.1 %", "no acne"};

/// The law over the resolutions, at one combination of all else.
struct CurveLaw {
  LawOf of = LawOf::least_error;
  std::vector<Value> others;           ///< values of the other axes but the resolution
  std::optional<BiasFit> law;          ///< at the slope-scaled bias nearest to 0
  std::size_t left_out = 0;            ///< resolutions without a point for it
  std::optional<BiasFit> over_slopes;  ///< at all of them, where there are several
};

struct BiasCurves {
  std::vector<Column> others;    ///< the axes that are no bias
  std::vector<Column> of_a_law;  ///< those that are no resolution either
  bool varies_constant = false;
  bool varies_slope = false;
  std::vector<BiasCurve> curves;         ///< in the order of cells
  std::vector<CurveLaw> laws;            ///< none where the resolution is not varied
  std::vector<double> constants;         ///< the axis of constant biases, ascending, in `unit`
  LengthUnit unit = LengthUnit::metres;  ///< of all constant biases: metres or texels
  std::size_t combinations = 0;          ///< how many curves there are; at most 200 are read
};

/// In metres, whatever the unit of the axis. Nothing where the line has no such bias, or has it at an end of the axis
/// beyond which it may lie.
std::optional<FitPoint> fit_point(const BiasCurves& curves, LawOf of, const BiasLine& line, double mean_texel);

/// The cell's constant bias in all units.
BiasInUnits in_units(const BiasCurves& curves, const BiasCurve& curve, const BiasCell& cell);

/// Nothing where no bias is varied, the truth is no binary visibility, or there are more than 4,096 slope-scaled
/// biases.
std::optional<BiasCurves> read_bias_curves(const SweepResults& sweep);

/// Adds the tables, a paragraph and lines for the console.
void present_bias(Presentation& presentation, const BiasCurves& curves);

/// A bias as people read it: "12.5 mm (0.43 texels)", with the slope-scaled one where that is varied.
std::string bias_text(const BiasCurves& curves, const BiasCurve& curve, const BiasCell& cell);
/// "1.2 mm + 0.87 texels".
std::string law_text(const BiasFit& law);
/// "RMS residual 3.9 mm (0.2 texels)", or that a fit through its points has none.
std::string residual_text(const BiasFit& law);

/// "curves" of summary.json.
nlohmann::ordered_json to_json(const BiasCurves& curves);

}  // namespace umbrameter
