// --dry-run: what a run would measure. Writes nothing; a sweep measures a few groups to estimate its time.
#pragma once

#include "app/command_line.h"
#include "core/error.h"
#include "experiments/sweep/sweep_evaluator.h"
#include "reports/files/console.h"

namespace umbrameter {

/// Of compare, trace and raster: scene, view, lights, what is rendered, files. Renders nothing.
ExitCode show_image_plan(const CommandLine& line, const Console& console, Stages& stages, const Experiment& experiment);

struct PlannedSweep {
  Experiment experiment;
  const std::vector<SweepAxis>& axes;
  const SweepPlan& plan;
  const CellStatistics& statistics;
};

/// Of a sweep: scene, view, light, axes, cells, groups, and the time that it would take. The estimate measures the
/// first group and, for each axis, the first and the last group at which it changes, for at most about 20 s.
ExitCode show_sweep_plan(const Console& console, Stages& stages, const PlannedSweep& sweep);

struct TimeEstimate {
  double seconds = 0.0;         ///< of all groups
  std::size_t measured = 0;     ///< groups that were measured for it
  bool is_upper_bound = false;  ///< some axis was not measured, and was taken to cost as much as the first group
};

/// Calls measure(group index), which returns its seconds, in an order that changes one axis at a time, until `budget`
/// seconds are spent.
TimeEstimate estimate_time(const SweepPlan& plan, double budget, const std::function<double(std::size_t)>& measure);

}  // namespace umbrameter
