// The estimated time of a sweep's groups by stage, and shards of equal time.
#include "experiments/settings/sweep_costs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/settings/experiment.h"
#include "experiments/settings/shard_cuts.h"

namespace umbrameter {
namespace {

SweepPlan sweep_of(const std::vector<const char*>& texts, const InnerKeys& inner = {}) {
  Experiment experiment;
  const Parameters parameters = describe(experiment);
  std::vector<SweepAxis> axes;
  for (const char* text : texts) axes.push_back(parse_axis(parameters, text));
  return plan_sweep(parameters, axes, cost_of_change, inner);
}

// Two angles of the light, three resolutions, eight filter sizes: the light changes least often.
SweepPlan whole_sweep() {
  return sweep_of({"shadow.filter-size=3:17:8", "shadow.resolution=256,512,1024", "light.angle=1,2"});
}

// What a process does that keeps the last result of each stage: a reference of 100 s for each degree, a map of 1 s for
// 256² texels, a look-up of 0.1 s for each texel of the filter and each cell of a group, and 5 s for its first group.
struct Machine {
  double angle = 0.0;
  std::int64_t resolution = 0;

  GroupTime operator()(const CellGroup& group) {
    GroupTime time;
    const double next_angle = number(group, 2);
    const auto next_resolution = static_cast<std::int64_t>(number(group, 1));
    if (angle == 0.0) time.rest += 5.0;
    if (next_angle != angle) time.of_stage[static_cast<std::size_t>(Stage::area_reference)] = 100.0 * next_angle;
    if (next_resolution != resolution) {
      time.of_stage[static_cast<std::size_t>(Stage::map)] =
          static_cast<double>(next_resolution * next_resolution) / (256.0 * 256.0);
    }
    angle = next_angle;
    resolution = next_resolution;
    time.rest += 0.1 * number(group, 0) * static_cast<double>(group.size());
    return time;
  }
  static double number(const CellGroup& group, std::size_t axis) { return to_number(group.values[axis]); }
};

double seconds_of(const SweepPlan& plan, std::size_t begin, std::size_t end) {
  Machine machine;
  double seconds = 0.0;
  for_each_joined_group(plan, begin, end - begin, [&](const CellGroup& group) {
    const GroupTime time = machine(group);
    seconds += time.rest;
    for (const double of_stage : time.of_stage) seconds += std::max(of_stage, 0.0);
  });
  return seconds;
}

TEST(SweepCosts, A_few_groups_give_the_time_of_any_run_of_groups) {
  const SweepPlan all = whole_sweep();
  const SweepCosts costs = measure_costs(all, 1e6, Machine());
  EXPECT_LT(costs.measured, 20u) << "of 48";
  EXPECT_NEAR(costs.start_seconds, 5.0, 1e-9);
  const GroupCosts groups(costs, all);
  for (const std::size_t begin : {0u, 24u, 5u, 40u}) {
    for (std::size_t end = begin + 1; end <= 48; ++end) {
      EXPECT_NEAR(groups.seconds(begin, end), seconds_of(all, begin, end), 1e-6) << begin << " to " << end;
    }
  }
}

TEST(SweepCosts, Six_groups_are_enough_to_know_what_each_axis_costs) {
  const SweepPlan all = whole_sweep();
  std::size_t measured = 0;
  Machine machine;
  // The clock says that the time is over after six.
  const SweepCosts costs = measure_costs(all, 1.0, [&](const CellGroup& group) {
    GroupTime time = machine(group);
    time.rest *= 1e-9;
    for (double& of_stage : time.of_stage) of_stage *= 1e-9;
    if (++measured == 6) time.rest += 1.0;
    return time;
  });
  EXPECT_EQ(costs.measured, 6u) << "a process's first group, again, the ends of three axes, and the first again";
  const GroupCosts groups(costs, all);
  const auto at = [&](std::size_t group) { return 1e9 * (groups.seconds(0, group + 1) - groups.seconds(0, group)); };
  EXPECT_NEAR(at(24), 200.0 + 1.0 + 0.3, 0.1) << "the other angle";
  EXPECT_NEAR(at(16), 16.0 + 0.3, 0.1) << "the largest map";
}

TEST(SweepCosts, A_time_between_measured_values_follows_a_power_of_the_parameter) {
  // Ten resolutions, of which at most five are measured; a map takes their square.
  const SweepPlan all = sweep_of({"shadow.filter-size=3,5", "shadow.resolution=128:1280:10", "light.angle=1"});
  const GroupCosts groups(measure_costs(all, 1e6, Machine()), all);
  for (std::size_t begin = 0; begin < 20; ++begin) {
    EXPECT_NEAR(groups.seconds(begin, begin + 1), seconds_of(all, begin, begin + 1), 1e-6) << begin;
  }
}

TEST(SweepCosts, Without_time_to_measure_the_stages_that_read_an_axis_run_again_with_it) {
  const SweepPlan all = whole_sweep();
  const SweepCosts costs = measure_costs(all, 0.0, Machine());
  EXPECT_EQ(costs.measured, 1u);
  // 100 s + 1 s + 5.3 s at first, then 5.3 s for each of eight filters, 1 s for each of three maps.
  EXPECT_NEAR(GroupCosts(costs, all).seconds(0, 24), 100.0 + 3 * 1.0 + 24 * 5.3, 1e-6);
}

TEST(SweepCosts, Shards_cover_all_groups_once_and_no_more_than_there_are) {
  const SweepPlan all = whole_sweep();
  const GroupCosts groups(measure_costs(all, 1e6, Machine()), all);
  for (const std::size_t shards : {1u, 2u, 5u, 7u, 48u, 100u}) {
    const std::vector<std::size_t> first = groups.cut(shards);
    EXPECT_EQ(first.size(), std::min<std::size_t>(shards, 48));
    EXPECT_EQ(first.front(), 0u);
    EXPECT_LT(first.back(), 48u);
    for (std::size_t i = 1; i < first.size(); ++i) EXPECT_LT(first[i - 1], first[i]);
  }
}

TEST(SweepCosts, One_shard_holds_all_groups_however_their_sum_is_rounded) {
  const SweepPlan all = sweep_of({"shadow.resolution=64,128,256", "shadow.filter=nearest,box"});
  for (int i = 1; i < 200; ++i) {
    SweepCosts costs;
    costs.start_seconds = 0.01 * i / 7.0;
    costs.parts = {{i / 300.0, true, {{1.0, 1.1, 1.3}, {1.0, 1.7}}}};
    EXPECT_EQ(GroupCosts(costs, all).cut(1).size(), 1u) << i;
  }
}

TEST(SweepCosts, A_cut_lies_where_an_expensive_axis_changes) {
  const SweepPlan all = sweep_of({"shadow.filter-size=3:17:8", "shadow.resolution=256,512,1024", "light.angle=1,1.01"});
  const GroupCosts groups(measure_costs(all, 1e6, Machine()), all);
  EXPECT_EQ(groups.cut(2), (std::vector<std::size_t>{0, 24})) << "each has one reference";
}

TEST(SweepCosts, A_group_is_cut_where_there_are_more_shards_and_where_cells_are_measured_one_by_one) {
  const InnerKeys inner = {constant_bias_key, slope_bias_key};
  const SweepPlan one = sweep_of({"shadow.filter-size=3", "shadow.constant-bias=0:1:200", "light.angle=1"}, inner);
  // As whole_sweep() has them, the axes of the machine's values come first.
  const auto machine = [machine = Machine()](const CellGroup& group) mutable {
    CellGroup in_order = group;
    in_order.values = {group.values[0], std::int64_t{256}, 0.1};
    return machine(in_order);
  };
  const SweepCosts costs = measure_costs(one, 1e6, machine);
  EXPECT_NEAR(costs.share_of_piece, costs.piece, 0.01) << "a cell takes as long in any group";
  const ShardCuts cuts = cut_into_shards(costs, one, 8);
  ASSERT_EQ(cuts.first.size(), 8u);
  // 10 s for the reference and 1 s for the map in each; 5 s to start; 200 cells of 0.3 s.
  for (const double seconds : cuts.seconds) EXPECT_NEAR(seconds, 5.0 + 10.0 + 1.0 + 60.0 / 8, 1.5);
  EXPECT_NEAR(cuts.undivided, 5.0 + 10.0 + 1.0 + 60.0, 0.5);
  EXPECT_EQ(cut_into_shards(costs, one, 1000).first.size(), 200u) << "as many as there are cells";
  EXPECT_GE(count_shards_within(costs, one, 20.0), 15u) << "4 s of 60 s in each";
  EXPECT_LE(count_shards_within(costs, one, 20.0), 17u);
}

TEST(SweepCosts, A_pass_that_takes_all_biases_at_once_is_cut_only_for_more_shards) {
  const InnerKeys inner = {constant_bias_key, slope_bias_key};
  const SweepPlan passes = sweep_of({"shadow.filter-size=3,5,7,9,11", "shadow.constant-bias=0:1:100"}, inner);
  const auto measure = [](const CellGroup&) {
    GroupTime time;
    time.rest = 2.0;
    return time;
  };
  const SweepCosts costs = measure_costs(passes, 1e6, measure);
  EXPECT_EQ(costs.share_of_piece, 1.0);
  EXPECT_EQ(cut_into_shards(costs, passes, 3).parts, 1u);
  const ShardCuts cuts = cut_into_shards(costs, passes, 10);
  EXPECT_EQ(cuts.first.size(), 10u);
  for (const double seconds : cuts.seconds) EXPECT_NEAR(seconds, 2.0, 1e-6) << "each repeats the pass";
  EXPECT_EQ(count_shards_within(costs, passes, 0.5), 5u) << "more shards would not be shorter";
}

// The disk takes longer than the smallest box, and the largest box longest: measuring goes on from that one.
TEST(SweepCosts, The_values_that_take_longest_together_decide_the_estimate) {
  const SweepPlan all =
      sweep_of({"shadow.filter-size=3,5,7,9", "shadow.filter=box,vogel", "shadow.resolution=256,512"});
  const auto seconds = [](const CellGroup& group) {
    const double size = to_number(group.values[0]);
    const double filter = to_string(group.values[1]) == "vogel" ? 2.0 : std::pow(size / 3.0, 2.25);
    return filter * (to_number(group.values[2]) == 256.0 ? 1.0 : 0.7);
  };
  const SweepCosts costs = measure_costs(all, 1e6, [&](const CellGroup& group) {
    GroupTime time;
    time.rest = seconds(group);
    return time;
  });
  double expected = 0.0;
  for (std::size_t i = 0; i < count_groups(all); ++i) expected += seconds(group_at(all, i));
  EXPECT_NEAR(GroupCosts(costs, all).seconds(0, count_groups(all)), expected, 0.2 * expected);
}

TEST(SweepCosts, A_million_groups_are_cut_into_shards_of_equal_cost) {
  const SweepPlan many = sweep_of({"shadow.slope-bias=0:1:1000", "shadow.constant-bias=0:1:1000"});
  SweepCosts costs;  // cells of 1 s; every thousandth has a map of 10 s, too
  costs.parts = {{10.0, false, {std::vector<double>(1000, 1.0), {}}},
                 {1.0, true, {std::vector<double>(1000, 1.0), std::vector<double>(1000, 1.0)}}};
  const ShardCuts cuts = cut_into_shards(costs, many, 64);
  ASSERT_EQ(cuts.first.size(), 64u);
  const auto [least, most] = std::minmax_element(cuts.seconds.begin(), cuts.seconds.end());
  EXPECT_LT(*most / *least, 1.1);
}

}  // namespace
}  // namespace umbrameter
