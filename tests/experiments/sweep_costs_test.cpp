// The estimated time of a sweep's groups, and shards of equal time.
#include "experiments/settings/sweep_costs.h"

#include <gtest/gtest.h>

#include "experiments/settings/experiment.h"
#include "experiments/settings/stage_inputs.h"

namespace umbrameter {
namespace {

// Two angles of the light, three resolutions, eight filter sizes: the light changes least often.
SweepPlan plan() {
  Experiment experiment;
  const Parameters parameters = describe(experiment);
  std::vector<SweepAxis> axes;
  for (const char* axis : {"shadow.filter-size=3:17:8", "shadow.resolution=256,512,1024", "light.angle=1,2"}) {
    axes.push_back(parse_axis(parameters, axis));
  }
  return plan_sweep(parameters, axes, cost_of_change, {});
}

// A reference takes 100 s, a map 10 s, a cell 1 s.
double seconds_of_group(std::size_t group) {
  return 1.0 + (group % 8 == 0 ? 10.0 : 0.0) + (group % 24 == 0 ? 100.0 : 0.0);
}

TEST(SweepCosts, A_few_groups_of_each_level_give_the_time_of_any_run_of_groups) {
  const SweepCosts costs = measure_costs(plan(), 1e6, seconds_of_group);
  EXPECT_EQ(costs.measured, 7u) << "the first group, the only change of the reference, two of the map, three of eight";
  EXPECT_FALSE(costs.is_upper_bound);
  for (const std::size_t begin : {0u, 24u, 5u}) {
    for (std::size_t end = begin + 1; end <= 48; ++end) {
      double expected = 111.0;  // a process begins with all of it
      for (std::size_t group = begin + 1; group < end; ++group) expected += seconds_of_group(group);
      EXPECT_DOUBLE_EQ(seconds_of(costs, begin, end), expected) << begin << " to " << end;
    }
  }
}

TEST(SweepCosts, A_cost_that_grows_along_an_axis_is_interpolated_between_its_ends_and_the_middle) {
  // Filter sizes 3 to 17: the places 1, 4 and 7 of each run of eight are measured.
  const SweepCosts costs =
      measure_costs(plan(), 1e6, [](std::size_t group) { return static_cast<double>(group % 8 * (group % 8)); });
  // 1, then to 16 at place 4, then to 49 at place 7.
  const double expected[] = {0, 1, 6, 11, 16, 27, 38, 49};
  for (std::size_t group = 1; group < 8; ++group) {
    EXPECT_NEAR(seconds_of(costs, group - 1, group + 1) - seconds_of(costs, group - 1, group), expected[group], 1e-9);
  }
}

TEST(SweepCosts, A_level_that_there_was_no_time_to_measure_costs_as_much_as_the_first_group) {
  const SweepCosts costs = measure_costs(plan(), 0.0, seconds_of_group);
  EXPECT_TRUE(costs.is_upper_bound);
  EXPECT_EQ(costs.measured, 1u);
  EXPECT_DOUBLE_EQ(seconds_of(costs, 0, 48), 48 * 111.0);
}

TEST(SweepCosts, Shards_cover_all_groups_once_and_no_more_than_there_are) {
  const SweepCosts costs = measure_costs(plan(), 1e6, seconds_of_group);
  for (const std::size_t shards : {1u, 2u, 5u, 7u, 48u, 100u}) {
    const std::vector<std::size_t> first = cut_into_shards(costs, 48, shards);
    EXPECT_EQ(first.size(), std::min<std::size_t>(shards, 48));
    EXPECT_EQ(first.front(), 0u);
    EXPECT_LT(first.back(), 48u);
    for (std::size_t i = 1; i < first.size(); ++i) EXPECT_LT(first[i - 1], first[i]);
  }
}

TEST(SweepCosts, A_cut_is_moved_to_where_an_expensive_axis_changes) {
  const SweepCosts costs = measure_costs(plan(), 1e6, seconds_of_group);
  EXPECT_EQ(cut_into_shards(costs, 48, 2), (std::vector<std::size_t>{0, 24})) << "each has one reference";
}

std::vector<double> running_sums(std::size_t count, double seconds) {
  std::vector<double> sums;
  for (std::size_t i = 0; i < count; ++i) sums.push_back(static_cast<double>(i) * seconds);
  return sums;
}

TEST(SweepCosts, A_million_groups_are_cut_into_shards_of_equal_cost) {
  // Cells of 1 s; every thousandth has a map of 10 s, too.
  SweepCosts costs;
  costs.first_seconds = 11.0;
  costs.levels = {{1000, running_sums(1000, 11.0)}, {1, running_sums(1000, 1.0)}};
  const std::vector<std::size_t> first = cut_into_shards(costs, 1'000'000, 64);
  ASSERT_EQ(first.size(), 64u);
  double least = 1e9;
  double most = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double seconds = seconds_of(costs, first[i], i + 1 < first.size() ? first[i + 1] : 1'000'000);
    least = std::min(least, seconds);
    most = std::max(most, seconds);
  }
  // A cut moves by at most a sixteenth of a shard at either end.
  EXPECT_LT(most / least, 1.25);
}

}  // namespace
}  // namespace umbrameter
