// Decides what a sweep measures, and measures its groups of cells.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/measure.h"
#include "experiments/stages.h"
#include "experiments/sweep_plan.h"

namespace umbrameter {

/// The quantity that a sweep measures.
enum class SweptQuantity { visibility, ao, image };
std::string_view quantity_name(SweptQuantity quantity);   ///< "ao": as run.measure writes it
std::string_view quantity_title(SweptQuantity quantity);  ///< "ambient occlusion"
SweptQuantity quantity_of(const CellStatistics& statistics);

/// Whether any axis varies a parameter of this group or with this name: "ao.", "view.scene".
bool varies_group(const std::vector<SweepAxis>& axes, std::string_view group);

/// The quantity that the axes belong to, unless `given` selects one. Throws Error (usage) if they belong to both.
SweptQuantity choose_quantity(SweepMeasure given, const std::vector<SweepAxis>& axes);

/// The lights that the cells measure.
std::vector<std::uint32_t> swept_lights(const Stages& stages, const Experiment& experiment,
                                        const std::vector<SweepAxis>& axes);

/// The kind of statistics that suits every cell, with all values 0: SoftVisibilityStatistics if any cell's light has
/// extent; otherwise EdgeStatistics if any cell's technique does not sum comparisons; otherwise VisibilityStatistics.
CellStatistics choose_statistics(const Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                                 SweptQuantity quantity);

/// Whether one pass measures every constant and slope-scaled bias of a group.
bool is_one_pass(const Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                 const CellStatistics& statistics);

/// The experiment with these values of the axes.
Experiment at_cell(Experiment experiment, const std::vector<SweepAxis>& axes, const std::vector<Value>& values);

/// A function that measures groups with `stages`, which must outlive it.
EvaluateGroup make_evaluator(Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                             const CellStatistics& statistics);

}  // namespace umbrameter
