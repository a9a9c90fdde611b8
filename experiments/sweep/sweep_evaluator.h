// Decides what a sweep measures, and measures its groups of cells.
#pragma once

#include <vector>

#include "experiments/stages/stages.h"
#include "results/swept.h"

namespace umbrameter {

/// The lights that the cells of a shadow sweep measure: one for each value of view.light.
std::vector<std::uint32_t> swept_lights(const Stages& stages, const Experiment& experiment,
                                        const std::vector<SweepAxis>& axes, SweptQuantity quantity);

/// The kind of statistics that suits every cell, with all values 0. For shadows: SoftVisibilityStatistics if any cell
/// may have a sampled reference; otherwise EdgeStatistics if any cell's technique does not sum comparisons; otherwise
/// VisibilityStatistics.
CellStatistics choose_statistics(const Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                                 SweptQuantity quantity);

/// Whether one pass measures the statistics of every cell of a group.
bool is_one_pass(const Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                 const CellStatistics& statistics);

/// The experiment, which is in metres, with these values of the axes, in metres as well.
Experiment cell_in_metres(const Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                          const std::vector<Value>& values);

/// A function that measures groups with `stages`, which must outlive it. The experiment is in metres.
EvaluateGroup make_evaluator(Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                             const CellStatistics& statistics);

}  // namespace umbrameter
