#include "experiments/settings/sweep_costs.h"

#include <algorithm>
#include <set>
#include <utility>

namespace umbrameter {
namespace {

// Of the groups from 1 up to `end`, each after the one before it.
double seconds_before(const SweepCosts& costs, std::size_t end) {
  double seconds = 0.0;
  for (const SweepCosts::Level& level : costs.levels) {
    const std::size_t multiples = end == 0 ? 0 : (end - 1) / level.step;
    const std::size_t within = level.until.size();
    seconds += static_cast<double>(multiples / within) * level.until.back() + level.until[multiples % within];
  }
  return seconds;
}

// Running sums of costs that are linear between samples of (place, seconds); places begin at 1.
std::vector<double> sums_of(const std::vector<std::pair<std::size_t, double>>& samples, std::size_t count) {
  std::vector<double> until = {0.0};
  std::size_t next = 0;
  for (std::size_t place = 1; place < count; ++place) {
    while (next + 1 < samples.size() && samples[next].first < place) ++next;
    const auto& [right, after] = samples[next];
    double seconds = after;
    if (place < right) {
      const auto& [left, before] = samples[next - 1];
      seconds = before + (after - before) * static_cast<double>(place - left) / static_cast<double>(right - left);
    }
    until.push_back(until.back() + seconds);
  }
  return until;
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
  const auto add_level = [&](std::size_t step, std::size_t within) {
    costs.levels.push_back({step, sums_of({{1, costs.first_seconds}}, within)});
  };
  std::size_t step = count_groups(plan);
  for (const std::size_t axis : plan.outer) {
    const std::size_t outer_step = step;
    step /= plan.axes[axis].values.size();
    if (step < outer_step) add_level(step, outer_step / step);
  }
  // A large grid of biases is split into several groups.
  if (step > 1) add_level(1, step);
  for (auto level = costs.levels.rbegin(); level != costs.levels.rend(); ++level) {
    const std::size_t last = level->until.size() - 1;
    std::vector<std::pair<std::size_t, double>> samples;
    // The cost of a step may grow along the axis, as with the resolution.
    for (const std::size_t place : std::set<std::size_t>{1, (last + 1) / 2, last}) {
      if (spent < budget) samples.emplace_back(place, sample(place * level->step));
    }
    if (samples.empty()) {
      costs.is_upper_bound = true;
    } else {
      level->until = sums_of(samples, last + 1);
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
