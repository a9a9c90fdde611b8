// --dry-run: what a run would measure. Writes nothing; a sweep measures a few groups to estimate its time.
#pragma once

#include "app/command_line.h"
#include "core/error.h"
#include "experiments/settings/sweep_costs.h"
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
/// groups that measure_costs() chooses, with a budget of 20 s of work.
ExitCode show_sweep_plan(const Console& console, Stages& stages, const PlannedSweep& sweep);

/// The costs of its groups, from measuring some, with a budget in seconds by Stages::work_clock(). By that
/// clock in proportion to each other, in all by the clock on the wall.
SweepCosts measure_costs(Stages& stages, const PlannedSweep& sweep, double budget);

}  // namespace umbrameter
