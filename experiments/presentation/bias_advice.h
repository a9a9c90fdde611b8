// Which constant bias is right for one light's shadow map, from one pass over all of them. Only for hard shadows.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/bias_curves.h"
#include "compare/bias_units.h"
#include "experiments/stages.h"
#include "reports/page/page.h"

namespace umbrameter {

/// Exact errors at every constant bias of a fine axis, all else as in the experiment.
struct BiasAdvice {
  LengthUnit unit = LengthUnit::metres;  ///< of the biases: that of the experiment's own
  BiasCell used;                         ///< the experiment's bias
  BiasLine line;                         ///< what the axis holds
  std::vector<BiasCell> cells{};         ///< each bias of the axis and the one in use, ascending
  std::optional<TapFlips> flips{};       ///< on the axis of `cells`, if the technique has one tap per pixel
  double largest = 0.0;                  ///< the axis's upper end; the lower one is 0
  double mean_texel = 0.0;               ///< metres
  double depth_unit = 0.0;               ///< mean_depth_unit()
};

/// Whether no bias of the axis has less error than the one in use, or less by less than a hundredth of it.
bool is_best(const BiasAdvice& advice);

/// Whether the error still falls at the upper end of the axis, so that the least error is not known.
bool is_open_ended(const BiasAdvice& advice);

/// Whether advise_bias() gives flips for this experiment: its technique has one tap per pixel.
bool has_tap_flips(const Experiment& experiment);

/// One light's map and reference. At least one pixel must be counted. `further` biases, in the unit of the
/// experiment's own, become cells, too; they do not change what is recommended.
BiasAdvice advise_bias(Stages& stages, const Experiment& experiment, std::uint32_t light,
                       const std::vector<double>& further = {});

/// "acne 8.7 % at 1.5 texels (6.4 cm); use 2.8 texels (12 cm): total error 9.1 % → 1.2 %; free of acne from 3.5
/// texels".
std::string advice_text(const BiasAdvice& advice);

/// The bias in use, that of least error and the least one without acne, with the error of each by cause.
ReportTable advice_table(const BiasAdvice& advice);

/// "recommended_bias" of summary.json.
nlohmann::ordered_json to_json(const BiasAdvice& advice);

}  // namespace umbrameter
