// What a sweep measures at its cells, and how.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/sweep_plan.h"
#include "experiments/workbench.h"

namespace umbrameter {

/// Soft: some cell's light has extent, and all cells are told in its columns.
enum class Measure { visibility, soft_visibility, ao };

/// Whether a parameter of that group, or of that name, is varied: "ao.", "view.scene".
bool varies_group(const std::vector<SweepAxis>& axes, std::string_view group);

/// Never soft_visibility, which depends on the scene. Throws Error (usage) where the axes belong to both.
Measure choose_measure(SweepMeasure given, const std::vector<SweepAxis>& axes);

/// The lights that any cell is about.
std::vector<std::uint32_t> swept_lights(const Workbench& workbench, const Experiment& experiment,
                                        const std::vector<SweepAxis>& axes);

/// Whether any cell's light has extent.
bool has_soft_cells(const Workbench& workbench, const Experiment& experiment, const std::vector<SweepAxis>& axes);

/// The measured columns, and a row of them that tells their kinds.
std::vector<Column> columns_of(Measure measure);
std::vector<Value> sample_row(Measure measure);

/// The experiment with these values of the axes.
Experiment at_cell(Experiment experiment, const std::vector<SweepAxis>& axes, const std::vector<Value>& values);

/// Measures groups on the workbench, which must outlive it.
EvaluateGroup make_evaluator(Workbench& workbench, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                             Measure measure);

}  // namespace umbrameter
