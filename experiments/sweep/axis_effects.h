// Which parameters a measurement reads, so that no axis of a sweep or a tuning is measured that changes nothing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/stages/stages.h"
#include "experiments/sweep/sweep_evaluator.h"

namespace umbrameter {

/// Whether the quantity depends on the parameter with this full name in this experiment: a stage of the measurement
/// reads it (stage_inputs.h), and so do the techniques with their present settings.
bool is_read(SweptQuantity quantity, Experiment experiment, std::string_view parameter);

/// Throws Error (usage) unless is_read(). The message names a setting with which the parameter would be read.
void require_read(SweptQuantity quantity, const Experiment& experiment, const std::string& parameter);

/// Throws Error (usage) for an axis that no combination of the axes' values reads in any of the experiments. `others`
/// are axes that are varied as well, but not tested. The message names a setting with which the axis would be read.
void require_effect(SweptQuantity quantity, const std::vector<Experiment>& experiments,
                    const std::vector<SweepAxis>& axes, const std::vector<SweepAxis>& others = {});

}  // namespace umbrameter
