// Runs a sweep in memory, for programs that link the libraries. The command line stores rows on disk (stored_sweep.h).
#pragma once

#include <string>
#include <vector>

#include "core/table.h"
#include "experiments/stages/stages.h"

namespace umbrameter {

/// One row per cell: the values of the axes, then the measured columns. The last axis varies fastest. Axes have the
/// syntax of --vary: "shadow.constant-bias=0:0.1:33". A sweep of shadows measures the first light that
/// experiment.view.light selects. Throws Error (usage) like parse_axis() and plan_sweep().
Table sweep_table(Stages& stages, const Experiment& experiment, const std::vector<std::string>& axes);

}  // namespace umbrameter
