#include "experiments/tune/tune_significance.h"

#include <algorithm>
#include <cmath>

#include "core/interrupt.h"
#include "core/jackknife.h"
#include "core/quantiles.h"

namespace umbrameter {
namespace {

// value_without(case, block) is the whole value with that block of that case left out. Cases are independent, so that
// their variances add up.
std::optional<Estimate> jackknife(double value, const LeftOutBlocks& blocks,
                                  const std::function<double(std::size_t, std::size_t)>& value_without) {
  if (few_blocks(blocks) > 0) return std::nullopt;
  double variance = 0.0;
  double squares = 0.0;  // of the cases' variances over their degrees of freedom
  for (std::size_t c = 0; c < blocks.size(); ++c) {
    const std::size_t count = blocks[c].without.size();
    if (count < 2) return std::nullopt;
    std::vector<double> values;
    for (std::size_t b = 0; b < count; ++b) values.push_back(value_without(c, b));
    const JackknifeVariance of_case = jackknife_variance(values, blocks[c].places);
    variance += of_case.variance;
    squares += of_case.variance * of_case.variance / of_case.degrees_of_freedom;
  }
  if (!std::isfinite(variance) || !std::isfinite(value)) return std::nullopt;
  // Degrees of freedom of a sum of variances: Welch 1947.
  const double half_width = variance > 0.0 ? student_95(variance * variance / squares) * std::sqrt(variance) : 0.0;
  return Estimate{value, value - half_width, value + half_width};
}

double cost(const TuneGoal& goal, std::vector<CaseValues> cases, std::size_t replaced, const CaseValues& by) {
  cases[replaced] = by;
  return total_cost(goal, cases);
}

// How far the cost can lie below and above what was measured, because noise of the reference may have raised columns.
struct CostNoise {
  double below = 0.0;
  double above = 0.0;
};

CostNoise cost_noise(const TuneGoal& goal, const std::vector<CaseValues>& cases, const LeftOutBlocks& blocks) {
  std::vector<CaseValues> least = cases;
  std::vector<CaseValues> most = cases;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    for (std::size_t column = 0; column < blocks[c].noise.size(); ++column) {
      double weight = 0.0;
      for (const TuneTerm& term : goal.terms) weight += term.column == column ? term.weight : 0.0;
      (weight > 0.0 ? least : most)[c][column] -= blocks[c].noise[column];
    }
  }
  const double measured = total_cost(goal, cases);
  return {measured - total_cost(goal, least), total_cost(goal, most) - measured};
}

bool have_same_blocks(const LeftOutBlocks& a, const LeftOutBlocks& b) {
  return std::ranges::equal(
      a, b, [](const BlocksOfCase& x, const BlocksOfCase& y) { return x.without.size() == y.without.size(); });
}

// Where the default has lost a block of a case, too.
TuneGoal without_block(TuneGoal goal, const LeftOutBlocks& of_default, std::size_t c, std::size_t block) {
  if (goal.is_relative) goal.of_default[c] = cost_of(goal, of_default[c].without[block]);
  return goal;
}

// Widens the interval of a total of a relative goal by what noise of the default can change in it; none where the
// default may be nothing but noise.
std::optional<Estimate> with_noise_of_default(Estimate interval, const TuneGoal& goal, const LeftOutBlocks& of_default,
                                              const std::function<double(const TuneGoal&)>& total) {
  if (!goal.is_relative) return interval;
  const double measured = total(goal);
  // Noise raises columns, and so costs of positive weight, and lowers the others.
  for (const double sign : {1.0, -1.0}) {
    TuneGoal without_noise = goal;
    for (std::size_t c = 0; c < of_default.size(); ++c) {
      for (const TuneTerm& term : goal.terms) {
        const bool counts = term.weight * sign > 0.0 && !of_default[c].noise.empty();
        if (counts) without_noise.of_default[c] -= term.weight * of_default[c].noise[term.column];
      }
      if (!(without_noise.of_default[c] > 0.0)) return std::nullopt;
    }
    const double change = total(without_noise) - measured;
    interval.lower += std::min(change, 0.0);
    interval.upper += std::max(change, 0.0);
  }
  return interval;
}

}  // namespace

std::size_t few_blocks(const LeftOutBlocks& blocks) {
  std::size_t count = 0;
  for (const BlocksOfCase& each : blocks) count += each.without.size();
  return count < fewest_blocks ? count : 0;
}

LeftOutBlocks leave_out_blocks(const std::vector<TuneCase>& cases, const TuneGoal& goal,
                               const std::function<Experiment(const TuneCase&)>& at) {
  LeftOutBlocks blocks;
  for (const TuneCase& each : cases) {
    throw_if_interrupted();
    blocks.push_back(measure_without_blocks(each, at(each), goal));
  }
  return blocks;
}

std::optional<Estimate> cost_interval(const TuneGoal& goal, const std::vector<CaseValues>& cases,
                                      const LeftOutBlocks& blocks, const LeftOutBlocks& of_default) {
  if (goal.is_relative && !have_same_blocks(blocks, of_default)) return std::nullopt;
  std::optional<Estimate> interval = jackknife(total_cost(goal, cases), blocks, [&](std::size_t c, std::size_t b) {
    return cost(without_block(goal, of_default, c, b), cases, c, blocks[c].without[b]);
  });
  if (!interval) return interval;
  const CostNoise noise = cost_noise(goal, cases, blocks);
  interval->lower -= noise.below;
  interval->upper += noise.above;
  interval =
      with_noise_of_default(*interval, goal, of_default, [&](const TuneGoal& of) { return total_cost(of, cases); });
  if (interval && !has_negative_costs(goal)) interval->lower = std::max(interval->lower, 0.0);
  return interval;
}

std::optional<Estimate> cost_difference(const TuneGoal& goal, const std::vector<CaseValues>& a,
                                        const LeftOutBlocks& blocks_a, const std::vector<CaseValues>& b,
                                        const LeftOutBlocks& blocks_b, const LeftOutBlocks& of_default) {
  if (!have_same_blocks(blocks_a, blocks_b)) return std::nullopt;
  if (goal.is_relative && !have_same_blocks(blocks_a, of_default)) return std::nullopt;
  const double difference = total_cost(goal, a) - total_cost(goal, b);
  std::optional<Estimate> interval = jackknife(difference, blocks_a, [&](std::size_t c, std::size_t block) {
    const TuneGoal without = without_block(goal, of_default, c, block);
    return cost(without, a, c, blocks_a[c].without[block]) - cost(without, b, c, blocks_b[c].without[block]);
  });
  if (!interval) return interval;
  const CostNoise of_a = cost_noise(goal, a, blocks_a);
  const CostNoise of_b = cost_noise(goal, b, blocks_b);
  interval->lower -= of_a.below + of_b.above;
  interval->upper += of_a.above + of_b.below;
  return with_noise_of_default(*interval, goal, of_default,
                               [&](const TuneGoal& of) { return total_cost(of, a) - total_cost(of, b); });
}

}  // namespace umbrameter
