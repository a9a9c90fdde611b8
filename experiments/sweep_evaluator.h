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
std::string_view quantity_name(SweptQuantity quantity);   ///< as in run.measure: "ao"
std::string_view quantity_title(SweptQuantity quantity);  ///< for sentences: "ambient occlusion"
SweptQuantity quantity_of(const CellStatistics& statistics);

/// Whether an axis varies a parameter whose name begins with `group`: "ao.", "view.scene".
bool varies_group(const std::vector<SweepAxis>& axes, std::string_view group);

/// The quantity that the axes affect, unless `given` selects one. Throws Error (usage) if they vary
/// both shadows and AO.
SweptQuantity choose_quantity(SweepMeasure given, const std::vector<SweepAxis>& axes);

/// The lights that the cells of a shadow sweep measure: one for each value of view.light.
std::vector<std::uint32_t> swept_lights(const Stages& stages, const Experiment& experiment,
                                        const std::vector<SweepAxis>& axes, SweptQuantity quantity);

/// The kind of statistics that suits every cell, with all values 0. For shadows: SoftVisibilityStatistics if any cell
/// may have a sampled reference; otherwise EdgeStatistics if any cell's technique does not sum comparisons; otherwise
/// VisibilityStatistics.
CellStatistics choose_statistics(const Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                                 SweptQuantity quantity);

/// The image metrics of each cell, which run.metrics names and the statistics lack. They need the image of each cell.
std::vector<MetricColumn> swept_metrics(const Experiment& experiment, const CellStatistics& statistics);

/// The measured columns of a cell: its statistics, then its image metrics.
std::vector<Column> measured_columns(const Experiment& experiment, CellStatistics statistics);
/// A row with these columns, of values 0.
std::vector<Value> sample_row(const Experiment& experiment, CellStatistics statistics);

/// The parameters whose combinations form a group of cells. Shadows: the biases. Ambient occlusion: what one pass
/// measures, or none if the technique, in any cell, measures each cell alone.
InnerKeys inner_keys(const Experiment& experiment, const std::vector<SweepAxis>& axes, SweptQuantity quantity);

/// Whether one pass measures the statistics of every cell of a group.
bool is_one_pass(const Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                 const CellStatistics& statistics);

/// The experiment with these values of the axes.
Experiment at_cell(Experiment experiment, const std::vector<SweepAxis>& axes, const std::vector<Value>& values);

/// A function that measures groups with `stages`, which must outlive it.
EvaluateGroup make_evaluator(Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                             const CellStatistics& statistics);

}  // namespace umbrameter
