// A sweep in memory: for programs that link the libraries. The program stores its rows on disk (stored_sweep.h).
#pragma once

#include <string>
#include <vector>

#include "core/table.h"
#include "experiments/stages.h"

namespace umbrameter {

/// One row a cell, in the order of the axes with the last one running fastest: the values of the axes, then the
/// measured columns. Axes are written as for --vary: "shadow.constant-bias=0:0.1:33". A sweep of shadows is about the
/// first light that experiment.view.light selects. Throws Error (usage) as parse_axis() and plan_sweep() do.
Table sweep_table(Stages& stages, const Experiment& experiment, const std::vector<std::string>& axes);

}  // namespace umbrameter
