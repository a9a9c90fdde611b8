// --dry-run: what a run would measure. Writes nothing; a sweep measures a few groups to estimate its time.
#pragma once

#include "app/sweep_run.h"
#include "experiments/settings/sweep_costs.h"

namespace umbrameter {

/// Of compare, trace and raster: scene, view, lights, what is rendered, files. Renders nothing.
ExitCode show_image_plan(const CommandLine& line, const Console& console, Stages& stages, const Experiment& experiment);

/// Of a sweep: scene, view, light, axes, cells, groups, and the time that it would take. The estimate measures the
/// groups that measure_costs() chooses.
ExitCode show_sweep_plan(const Console& console, SweepRun& sweep);

/// The costs of its groups, from measuring some within cost_budget. Their proportions are by Stages::work_clock(),
/// their sum is time by the clock on this machine.
SweepCosts measure_costs(SweepRun& sweep);

}  // namespace umbrameter
