// A recommended bias in the numbers of an engine, and the error that these numbers have.
#pragma once

#include <optional>
#include <string>

#include "compare/bias_curves.h"
#include "core/parameters.h"
#include "techniques/engine_bias/conversion.h"

namespace umbrameter {

/// Errors are those of the run's own settings with the bias that the engine's numbers mean.
struct EngineAdvice {
  ConvertedTarget target;                  ///< set_values() are what to set
  std::optional<BiasCell> measured{};      ///< with set_values(); `constant` and `slope` are not set
  std::optional<BiasCell> by_default{};    ///< with the engine's defaults, likewise
  std::string why_not_measured{};          ///< which part of set_values() our parameters cannot say
  std::optional<CasterFaces> own_faces{};  ///< that cast in the engine, if others than in the run
  bool has_own_offset = false;             ///< it has another polygon offset than the run besides its numbers
  bool has_one_number = false;             ///< for the bias at all places, where it is not in proportion to the run's
  /// Why it has no number for the run's normal offset, which is then left out; empty if it has one.
  std::string lost_offset{};
  double left_out_slope = 0.0;       ///< the run's shadow.slope-bias, which `measured` and `by_default` are without
  std::optional<Length> own_bias{};  ///< the constant bias that was found under these conditions, if one could be
  bool is_shared = false;            ///< the numbers are those of all cases of the light
};

}  // namespace umbrameter
