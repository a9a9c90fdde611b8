// Which constant bias is right for one light's shadow map, as measured in one pass over all of them.
#pragma once

#include <optional>
#include <vector>

#include "compare/bias_plateau.h"
#include "core/parameters.h"
#include "results/engine_advice.h"
#include "techniques/shadow/histogram.h"

namespace umbrameter {

/// Exact errors at constant biases of three significant digits, all else as in the experiment.
struct BiasAdvice {
  LengthUnit unit = LengthUnit::metres;  ///< of the biases: that of the experiment's own
  BiasCell used;                         ///< the experiment's bias
  BiasLine line;                         ///< what the measured biases hold
  BiasPlateau plateau;
  BiasEvidence evidence;
  std::optional<NoBias> withheld{};     ///< why plateau.recommended is not recommended
  std::vector<BiasCell> cells{};        ///< the measured biases thinned for a slider, with those above, ascending
  std::optional<TapFlips> flips{};      ///< on the axis of `cells`, if the technique has one tap per pixel
  double mean_texel = 0.0;              ///< metres
  bool texels_differ = false;           ///< from pixel to pixel: texels are metres only on average
  double depth_unit = 0.0;              ///< mean_depth_unit()
  std::vector<EngineAdvice> engines{};  ///< for named_bias(), in the numbers of the engines that run.for names
};

/// Whether the bias in use is as good as the recommended one: at most 5 % above the least error, with as little acne.
bool keeps_bias(const BiasAdvice& advice);

/// The bias to set: the one in use where that is as good, else the recommended one.
const BiasCell& named_bias(const BiasAdvice& advice);

}  // namespace umbrameter
