// The time that the groups of a sweep take, by stage, estimated from a few of them. A stage runs again when an axis on
// which it depends changes; its time is a product of factors, one for each of these axes.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "experiments/settings/stage_inputs.h"
#include "experiments/settings/sweep_plan.h"

namespace umbrameter {

/// What it took to measure a group, seconds.
struct GroupTime {
  std::vector<double> of_stage = std::vector<double>(stage_count, -1.0);  ///< by Stage; negative: it did not run
  double rest = 0.0;                                                      ///< what no stage keeps: look-ups, statistics
};

struct SweepCosts {
  /// A stage, or the rest.
  struct Part {
    double seconds = 0.0;    ///< at the first value of each axis
    bool is_within = false;  ///< runs in each group, and for a part of a group takes less; else where a factor changes
    std::vector<std::vector<double>> factors{};  ///< for each outer axis one for each value; empty: no dependence
  };
  double start_seconds = 0.0;  ///< of a process: loading, and what its first group takes besides its parts
  std::vector<Part> parts{};
  double piece = 1.0;           ///< a part of the first group that was measured, as a share of its cells
  double share_of_piece = 1.0;  ///< what is_within took for it, as a share of what it took for the whole group
  std::size_t measured = 0;     ///< groups that were measured
};

/// The usual budget of measure_costs(), seconds of work.
inline constexpr double cost_budget = 20.0;

using MeasureGroup = std::function<GroupTime(const CellGroup&)>;

/// Measures the first group, other values of each axis with the first values of the others, and with those that take
/// longest together, and a part of the first group, until `budget` seconds are spent, or 3 % of the time of the sweep
/// if that is more, but at most six times the budget. Of an axis of numbers its ends and some values between them, of
/// which the others are interpolated; of an axis of words as many as there is time for.
SweepCosts measure_costs(const SweepPlan& plan, double budget, const MeasureGroup& measure);

}  // namespace umbrameter
