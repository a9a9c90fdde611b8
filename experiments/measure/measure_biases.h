// Measures many biases in one pass.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/bias_facts.h"
#include "compare/bias_plateau.h"
#include "compare/visibility.h"
#include "experiments/stages/stages.h"

namespace umbrameter {

/// The shadow error at every combination of slope-scaled and constant biases, which replace the experiment's: one list
/// for each slope-scaled bias, in the order of the constant biases. These are in the unit of the experiment's constant
/// bias, in any order. The technique's taps must not depend on the bias.
std::vector<std::vector<VisibilityStatistics>> measure_biases(Stages& stages, const Experiment& experiment,
                                                              std::uint32_t light, const std::vector<double>& constant,
                                                              const std::vector<double>& slope);

/// Metres per unit of the depth that the light's map stores: mean over the counted pixels, 0 if there is none. Of
/// own_range, per unit of the cascade's own.
double mean_depth_unit(Stages& stages, const Experiment& experiment, std::uint32_t light);

/// What the light's bias depends on besides the scene. NaN where a fact is not known: without counted pixels, or
/// if a search finds the filter's radius in each pixel (PCSS).
BiasFacts measure_bias_facts(Stages& stages, const Experiment& experiment, std::uint32_t light);

/// What the light's counted pixels show about its bias. The reference must be binary.
BiasEvidence measure_bias_evidence(Stages& stages, const Experiment& experiment, std::uint32_t light);

}  // namespace umbrameter
