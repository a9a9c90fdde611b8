// The time that the groups of a sweep take, estimated from a few of them, and a cut of the sweep into shards by it.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "experiments/settings/sweep_plan.h"

namespace umbrameter {

struct SweepCosts {
  /// Groups at which the outermost axis that changes is the same one; everything inside it starts again.
  struct Level {
    std::size_t step = 1;         ///< the groups whose index is a multiple of it, but of no outer level's
    std::vector<double> until{};  ///< [j]: seconds of the first j such groups, up to the next outer level's; [0] is 0
  };
  double first_seconds = 0.0;   ///< of the group that a process measures first
  std::vector<Level> levels{};  ///< the outermost one first
  std::size_t measured = 0;     ///< groups that were measured
  bool is_upper_bound = false;  ///< a level was not measured, and was taken to cost as much as the first group
};

/// Calls measure(group index), which returns its seconds, for the first group and for the first, the middle and the
/// last group of each level, until `budget` seconds are spent. Between them the costs of a level are interpolated.
SweepCosts measure_costs(const SweepPlan& plan, double budget, const std::function<double(std::size_t)>& measure);

/// Time of a process that measures the groups from `begin` up to `end`, seconds.
double seconds_of(const SweepCosts& costs, std::size_t begin, std::size_t end);

/// Cuts the groups into runs of equal cost, moved a little to where an outer axis changes, so that a shard shares maps
/// and references. Returns the first group of each shard; fewer shards than asked for if there are fewer groups.
std::vector<std::size_t> cut_into_shards(const SweepCosts& costs, std::size_t groups, std::size_t shards);

}  // namespace umbrameter
