// What a sweep measures at its cells, and how.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/measure.h"
#include "experiments/stages.h"
#include "experiments/sweep_plan.h"

namespace umbrameter {

/// What the axes belong to.
enum class SweptQuantity { visibility, ao };

/// Whether a parameter of that group, or of that name, is varied: "ao.", "view.scene".
bool varies_group(const std::vector<SweepAxis>& axes, std::string_view group);

/// Throws Error (usage) where the axes belong to both.
SweptQuantity choose_quantity(SweepMeasure given, const std::vector<SweepAxis>& axes);

/// The lights that any cell is about.
std::vector<std::uint32_t> swept_lights(const Stages& stages, const Experiment& experiment,
                                        const std::vector<SweepAxis>& axes);

/// The statistics that fit every cell, all values 0: those of an area light where some cell's light has extent, else
/// those about edges where some cell's technique does not sum comparisons, else those by cause.
CellStatistics choose_statistics(const Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                                 SweptQuantity quantity);

/// Whether one pass measures every constant and slope-scaled bias of a group.
bool is_one_pass(const Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                 const CellStatistics& statistics);

/// The experiment with these values of the axes.
Experiment at_cell(Experiment experiment, const std::vector<SweepAxis>& axes, const std::vector<Value>& values);

/// Measures groups on the stages, which must outlive it.
EvaluateGroup make_evaluator(Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                             const CellStatistics& statistics);

}  // namespace umbrameter
