#include "experiments/settings/sweep_costs.h"

#include <algorithm>

namespace umbrameter {
namespace {

// Multiples of `step` in [1, end).
std::size_t multiples(std::size_t step, std::size_t end) { return end == 0 ? 0 : (end - 1) / step; }

// Of the groups from 1 up to `end`, each after the one before it.
double seconds_before(const SweepCosts& costs, std::size_t end) {
  double seconds = 0.0;
  std::size_t outer = 0;
  for (const SweepCosts::Level& level : costs.levels) {
    const std::size_t all = multiples(level.step, end);
    seconds += level.seconds * static_cast<double>(all - outer);
    outer = all;
  }
  return seconds;
}

// The multiple of the outermost step that is no further than `reach` from the group.
std::size_t near_change(const SweepCosts& costs, std::size_t group, std::size_t reach) {
  for (const SweepCosts::Level& level : costs.levels) {
    const std::size_t nearest = (group + level.step / 2) / level.step * level.step;
    if (std::max(nearest, group) - std::min(nearest, group) <= reach) return nearest;
  }
  return group;
}

}  // namespace

SweepCosts measure_costs(const SweepPlan& plan, double budget, const std::function<double(std::size_t)>& measure) {
  SweepCosts costs;
  double spent = 0.0;
  const auto sample = [&](std::size_t group) {
    const double seconds = measure(group);
    spent += seconds;
    ++costs.measured;
    return seconds;
  };
  costs.first_seconds = sample(0);
  std::vector<std::size_t> steps_within;  // steps until the next outer axis changes
  const auto add_level = [&](std::size_t step, std::size_t within) {
    costs.levels.push_back({step, costs.first_seconds});
    steps_within.push_back(within);
  };
  std::size_t step = count_groups(plan);
  for (const std::size_t axis : plan.outer) {
    const std::size_t outer_step = step;
    step /= plan.axes[axis].values.size();
    if (step < outer_step) add_level(step, outer_step / step);
  }
  // A large grid of biases is split into several groups.
  if (step > 1) add_level(1, step);
  for (std::size_t i = costs.levels.size(); i-- > 0;) {
    SweepCosts::Level& level = costs.levels[i];
    if (spent >= budget) {
      costs.is_upper_bound = true;
      continue;
    }
    level.seconds = sample(level.step);
    // The cost of a step may grow along the axis, as with the resolution: the mean of both ends.
    if (steps_within[i] > 2 && spent < budget) {
      level.seconds = 0.5 * (level.seconds + sample((steps_within[i] - 1) * level.step));
    }
  }
  return costs;
}

double seconds_of(const SweepCosts& costs, std::size_t begin, std::size_t end) {
  return costs.first_seconds + seconds_before(costs, end) - seconds_before(costs, begin + 1);
}

std::vector<std::size_t> cut_into_shards(const SweepCosts& costs, std::size_t groups, std::size_t shards) {
  shards = std::min(shards, groups);
  const double all = seconds_before(costs, groups);
  std::vector<std::size_t> first = {0};
  for (std::size_t k = 1; k < shards; ++k) {
    const double wanted = all * static_cast<double>(k) / static_cast<double>(shards);
    std::size_t low = 0;
    std::size_t high = groups;
    while (low < high) {
      const std::size_t middle = low + (high - low) / 2;
      if (seconds_before(costs, middle) < wanted) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    const std::size_t group = near_change(costs, low, groups / shards / 16);
    first.push_back(std::clamp(group, first.back() + 1, groups - (shards - k)));
  }
  return first;
}

}  // namespace umbrameter
