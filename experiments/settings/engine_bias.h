// The axis of a sweep that varies the bias of an engine.
#pragma once

#include <optional>

#include "experiments/settings/experiment.h"
#include "experiments/settings/sweep.h"

namespace umbrameter {

/// The only axis of the experiment that is a bias of its engine (EngineParameter::bias), with its values in the order
/// in which they light more. Nothing if no axis is, or several are.
std::optional<SweepAxis> engine_bias_axis(Experiment experiment);

}  // namespace umbrameter
