// The rounds of a planned tuning. The cells of a round are the parts of its points (PointLayout), those of one part one
// after the other, so that a shard needs few references.
#pragma once

#include <cstddef>
#include <vector>

#include "app/planned_folder.h"
#include "app/tune_run.h"
#include "experiments/settings/shard_cuts.h"
#include "experiments/tune/tune_points.h"

namespace umbrameter {

/// How the plan's options name an axis, "KEY=AXIS": the axes of an experiment file are those of a sweep.
inline constexpr const char* axis_option = "vary";

/// The experiment of each scene of a plan.
std::vector<Experiment> tuned_experiments(const PlannedFolder& planned);

/// `job` is that of the plan.
PointLayout layout_of(const PlannedTuning& tuning, const TuneJob& job);

/// The goal as far as it is known: of a relative one with the default's costs.
TuneGoal planned_goal(const PlannedTuning& tuning, const TuneJob& job);

/// What of which round a cell of the plan is.
struct PlannedCell {
  TuneQuery query;
  std::size_t part = 0;
};

/// All cells of the plan, in order.
std::vector<PlannedCell> planned_cells(const PlannedTuning& tuning, const PointLayout& layout);

/// The cells as a sweep of one axis, for ScratchRows.
SweepPlan cells_as_sweep(std::size_t cells);

/// Adds a round of these points to the plan, cut into shards. Returns how it was cut.
ShardCuts add_round(ShardPlan& plan, const PointLayout& layout, const std::vector<TuneQuery>& points);

/// The identity of a tuning, short enough for a plan.
Identity portable_identity(TuneRun& run);

}  // namespace umbrameter
