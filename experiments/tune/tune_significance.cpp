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
                                      const LeftOutBlocks& blocks) {
  std::optional<Estimate> interval = jackknife(total_cost(goal, cases), blocks, [&](std::size_t c, std::size_t b) {
    return cost(goal, cases, c, blocks[c].without[b]);
  });
  if (!interval) return interval;
  const CostNoise noise = cost_noise(goal, cases, blocks);
  interval->lower -= noise.below;
  interval->upper += noise.above;
  if (!has_negative_costs(goal)) interval->lower = std::max(interval->lower, 0.0);
  return interval;
}

std::optional<Estimate> cost_difference(const TuneGoal& goal, const std::vector<CaseValues>& a,
                                        const LeftOutBlocks& blocks_a, const std::vector<CaseValues>& b,
                                        const LeftOutBlocks& blocks_b) {
  for (std::size_t c = 0; c < blocks_a.size(); ++c) {
    if (blocks_a[c].without.size() != blocks_b[c].without.size()) return std::nullopt;
  }
  const double difference = total_cost(goal, a) - total_cost(goal, b);
  std::optional<Estimate> interval = jackknife(difference, blocks_a, [&](std::size_t c, std::size_t block) {
    return cost(goal, a, c, blocks_a[c].without[block]) - cost(goal, b, c, blocks_b[c].without[block]);
  });
  if (!interval) return interval;
  const CostNoise of_a = cost_noise(goal, a, blocks_a);
  const CostNoise of_b = cost_noise(goal, b, blocks_b);
  interval->lower -= of_a.below + of_b.above;
  interval->upper += of_a.above + of_b.below;
  return interval;
}

}  // namespace umbrameter
