// A recommended bias in the numbers of other engines, measured again after rounding.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/stages/stages.h"
#include "results/engine_advice.h"

namespace umbrameter {

/// Why a light has no numbers of engines.
std::string no_engines_text(const Stages& stages, const Experiment& experiment, std::uint32_t light);

/// The experiment's bias in the numbers of the engines that its run.for names, for one light with a binary reference.
/// Empty if it names none. Throws Error (usage) for what parse_bias_targets() refuses.
std::vector<EngineAdvice> advise_engines(Stages& stages, const Experiment& experiment, std::uint32_t light);

struct EngineCase {
  Stages& stages;
  Experiment experiment;
  /// Constant bias to convert in place of the experiment's, in its unit, for engines that have a number for one.
  std::optional<double> recommended{};
  std::uint32_t light = 0;
};

/// The same for each of several cases, whose experiments name the same engines. Cases of one light have the same
/// numbers, since an engine has one for a light: the largest bias that one of them needs.
std::vector<std::vector<EngineAdvice>> advise_engines(const std::vector<EngineCase>& cases);

}  // namespace umbrameter
