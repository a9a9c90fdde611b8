// The bias of an experiment as what it does at each place of a light's map, and parameters that do the same: what a
// conversion to and from an engine's numbers starts and ends with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/settings/experiment.h"
#include "techniques/engine_bias/conversion.h"

namespace umbrameter {

/// The terms of the shadow.* biases at each place, metres; of the slope biases only the polygon offset. The layout is
/// that of with_depth_encoding(), and the places are its. Throws Error (usage) if receivers and casters both move along
/// their normals.
std::vector<BiasTerms> terms_of(const Experiment& experiment, const MapLayout& layout,
                                const std::vector<MapPlace>& places);

/// The experiment with these terms in place of its biases, and with no shadow.slope-bias. Empty if no parameter can
/// state one of the terms; `reason` then says which.
std::optional<Experiment> with_terms(Experiment experiment, const MapLayout& layout,
                                     const std::vector<MapPlace>& places, const std::vector<BiasTerms>& terms,
                                     std::string& reason);

}  // namespace umbrameter
