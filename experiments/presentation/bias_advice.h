// Which constant bias is right for one light's shadow map, from one pass over all of them. Only for hard shadows.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/bias_plateau.h"
#include "compare/bias_units.h"
#include "experiments/stages.h"
#include "reports/page/page.h"

namespace umbrameter {

/// Exact errors at constant biases of three significant digits, all else as in the experiment.
struct BiasAdvice {
  LengthUnit unit = LengthUnit::metres;  ///< of the biases: that of the experiment's own
  BiasCell used;                         ///< the experiment's bias
  BiasLine line;                         ///< what the measured biases hold
  BiasPlateau plateau;
  BiasEvidence evidence;
  std::optional<NoBias> withheld{};  ///< why plateau.recommended is not recommended
  std::vector<BiasCell> cells{};     ///< the measured biases thinned for a slider, with those above, ascending
  std::optional<TapFlips> flips{};   ///< on the axis of `cells`, if the technique has one tap per pixel
  double mean_texel = 0.0;           ///< metres
  double depth_unit = 0.0;           ///< mean_depth_unit()
};

/// Whether the bias in use is as good as the recommended one: at most 5 % above the least error, with as little acne.
bool keeps_bias(const BiasAdvice& advice);

/// Whether advise_bias() gives flips for this experiment: its technique has one tap per pixel.
bool has_tap_flips(const Experiment& experiment);

/// One light's map and reference. At least one pixel must be counted. Searches biases from a hundredth to a hundred
/// texels on both sides of 0, and farther where the plateau reaches an end. `further` biases, in the unit of the
/// experiment's own, become cells, too; they do not change what is recommended.
BiasAdvice advise_bias(Stages& stages, const Experiment& experiment, std::uint32_t light,
                       const std::vector<double>& further = {});

/// "use 2.8 texels (12 cm): error 9.1 % → 1.2 %; 2.6 to 3.1 texels are within 5 % of the least error, 1.2 %"; "keep …"
/// where the bias in use is as good; where none is recommended, why.
std::string advice_text(const BiasAdvice& advice);

/// The bias in use, the recommended one, the plateau's ends, that of least error and the least with little or no acne,
/// with the error of each by cause.
ReportTable advice_table(const BiasAdvice& advice);

/// "recommended_bias" of summary.json.
nlohmann::ordered_json to_json(const BiasAdvice& advice);

}  // namespace umbrameter
