#include "experiments/settings/sweep_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"
#include "experiments/settings/stage_inputs.h"

namespace umbrameter {
namespace {

// Parameters of the names that the order of evaluation is about.
struct Sample {
  int size = 1;
  int spp = 1;
  int resolution = 256;
  double constant_bias = 0.02;
  double slope_bias = 0.5;
  int filter_size = 3;
  std::string filter = "nearest";
};

Parameters describe(Sample& s) {
  return concatenate({Description("view").field("size", s.size, {"px", "size"}).take(),
                      Description("truth").field("spp", s.spp, {"1", "rays"}).take(),
                      Description("shadow")
                          .field("resolution", s.resolution, {"texels", "resolution"})
                          .field("constant-bias", s.constant_bias, {"m", "constant bias"})
                          .field("slope-bias", s.slope_bias, {"texels", "slope-scaled bias"})
                          .field("filter-size", s.filter_size, {"texels", "filter size"})
                          .field("filter", s.filter, {"", "filter"})
                          .take()});
}

SweepPlan plan_of(const std::vector<std::string>& assignments,
                  const InnerKeys& inner = {constant_bias_key, slope_bias_key}) {
  Sample sample;
  const Parameters parameters = describe(sample);
  std::vector<SweepAxis> axes;
  for (const std::string& assignment : assignments) axes.push_back(parse_axis(parameters, assignment));
  return plan_sweep(parameters, axes, cost_of_change, inner);
}

// Every cell's own values, got from its index alone: the last axis runs fastest.
std::vector<Value> grid_values(const SweepPlan& plan, std::size_t cell) {
  std::vector<Value> values(plan.axes.size());
  for (std::size_t a = plan.axes.size(); a-- > 0;) {
    values[a] = plan.axes[a].values[cell % plan.axes[a].values.size()];
    cell /= plan.axes[a].values.size();
  }
  return values;
}

// Every cell stands in one group, once, with its own values; no group is larger than allowed.
void expect_covered(const SweepPlan& plan) {
  std::vector<bool> seen(plan.cells);
  std::size_t count = 0;
  for (std::size_t g = 0; g < count_groups(plan); ++g) {
    const CellGroup group = group_at(plan, g);
    ASSERT_LE(group.size(), max_group_cells);
    for (std::size_t place = 0; place < group.size(); ++place) {
      const std::size_t cell = group.cell(place);
      ASSERT_LT(cell, plan.cells);
      ASSERT_FALSE(seen[cell]) << cell;
      seen[cell] = true;
      ++count;
      // Comparing all of a million would take longer than the plan.
      if (cell % 97 != 0 && plan.cells > 10'000) continue;
      ASSERT_EQ(values_at(group, place), grid_values(plan, cell)) << cell;
    }
  }
  EXPECT_EQ(count, plan.cells);
}

TEST(SweepPlan, Every_cell_stands_in_one_group_with_its_values_whatever_the_order_of_axes) {
  std::vector<std::string> axes = {"shadow.constant-bias=0:1:3", "shadow.filter=a,b", "shadow.resolution=256,512",
                                   "shadow.slope-bias=0:2:4", "truth.spp=1,2,3"};
  std::sort(axes.begin(), axes.end());
  int orders = 0;
  do {
    const SweepPlan plan = plan_of(axes);
    EXPECT_EQ(plan.cells, 3u * 2 * 2 * 4 * 3);
    EXPECT_EQ(count_groups(plan), 2u * 2 * 3);
    expect_covered(plan);
    for (std::size_t cell = 0; cell < plan.cells; ++cell) ASSERT_EQ(values_at(plan, cell), grid_values(plan, cell));
  } while (std::next_permutation(axes.begin(), axes.end()) && ++orders < 120);
}

TEST(SweepPlan, What_is_expensive_changes_least_often) {
  std::vector<std::string> axes = {"shadow.constant-bias=0,1",
                                   "shadow.filter-size=1,3,5,7,9",
                                   "shadow.filter=a,b",
                                   "shadow.resolution=256,512,1024",
                                   "truth.spp=1,2",
                                   "view.size=1,2,3,4"};
  std::sort(axes.begin(), axes.end());
  int orders = 0;
  do {
    const SweepPlan plan = plan_of(axes);
    std::map<std::string, int> changes;
    std::vector<Value> before;
    for (std::size_t g = 0; g < count_groups(plan); ++g) {
      const CellGroup group = group_at(plan, g);
      for (std::size_t a = 0; a < plan.axes.size(); ++a) {
        if (g > 0 && group.values[a] != before[a]) ++changes[plan.axes[a].key];
      }
      before = group.values;
    }
    // The first value is no change. A new truth belongs to each size, a new map to each truth.
    EXPECT_EQ(changes["view.size"], 4 - 1);
    EXPECT_EQ(changes["truth.spp"], 4 * 2 - 1);
    EXPECT_EQ(changes["shadow.resolution"], 4 * 2 * 3 - 1);
    EXPECT_EQ(changes.count("shadow.constant-bias"), 0u) << "one group has all of them";
  } while (std::next_permutation(axes.begin(), axes.end()) && ++orders < 60);
}

TEST(SweepPlan, Biases_that_are_not_varied_are_the_experiments_own) {
  const SweepPlan plan = plan_of({"shadow.resolution=256,512"});
  ASSERT_EQ(count_groups(plan), 2u);
  const CellGroup group = group_at(plan, 1);
  EXPECT_EQ(group.size(), 1u);
  EXPECT_EQ(group.inner[0].values, (std::vector<double>{0.02}));
  EXPECT_EQ(group.inner[1].values, (std::vector<double>{0.5}));
  EXPECT_FALSE(group.inner[0].axis);
  EXPECT_EQ(group.values, (std::vector<Value>{std::int64_t{512}}));
  EXPECT_EQ(values_at(group, 0), group.values);
  EXPECT_EQ(group.cell(0), 1u);
}

TEST(SweepPlan, A_huge_inner_grid_is_split_into_groups_that_keep_constant_biases_together) {
  const SweepPlan long_axis = plan_of({"shadow.constant-bias=0:1:1000000"});
  EXPECT_EQ(count_groups(long_axis), 16u) << "1,000,000 / 65,536, rounded up";
  expect_covered(long_axis);
  const SweepPlan wide =
      plan_of({"shadow.slope-bias=0:1:300", "shadow.resolution=1,2", "shadow.constant-bias=0:1:1000"});
  // 65 slope-scaled biases with 1,000 constant ones fit into 65,536 cells: five equal groups for 300 of them.
  EXPECT_EQ(count_groups(wide), 2u * 5);
  EXPECT_EQ(group_at(wide, 0).inner[0].values.size(), 1000u);
  EXPECT_EQ(group_at(wide, 0).inner[1].values.size(), 60u);
  expect_covered(wide);
  const SweepPlan both = plan_of({"shadow.slope-bias=0:1:3", "shadow.constant-bias=0:1:100000"});
  EXPECT_EQ(count_groups(both), 3u * 2);
  expect_covered(both);
}

TEST(SweepPlan, A_group_of_a_billion_cells_is_made_from_its_number_at_once) {
  const SweepPlan plan = plan_of({"shadow.filter-size=1:999999:500000", "shadow.resolution=1:2000:2000"});
  ASSERT_EQ(plan.cells, 1'000'000'000u);
  ASSERT_EQ(count_groups(plan), 1'000'000'000u);
  const CellGroup last = group_at(plan, 999'999'999);
  EXPECT_EQ(last.first_cell, 999'999'999u);
  EXPECT_EQ(last.values, (std::vector<Value>{std::int64_t{999'999}, std::int64_t{2000}}));
  // The filter changes first: the second group differs from the first in it alone.
  EXPECT_EQ(group_at(plan, 1).values, (std::vector<Value>{std::int64_t{3}, std::int64_t{1}}));
  EXPECT_EQ(group_at(plan, 1).first_cell, 2000u);
}

TEST(SweepPlan, Any_parameters_form_groups_and_none_leave_each_cell_alone) {
  const std::vector<std::string> axes = {"truth.spp=1,2,3", "shadow.constant-bias=0:1:4", "shadow.filter-size=1,3",
                                         "shadow.resolution=256,512"};
  const SweepPlan three = plan_of(axes, {"shadow.filter-size", "truth.spp", "shadow.slope-bias"});
  EXPECT_EQ(count_groups(three), 4u * 2);
  EXPECT_EQ(group_at(three, 0).size(), 2u * 3);
  expect_covered(three);
  EXPECT_EQ(values_at(group_at(three, 0), 1)[0], Value(std::int64_t{2})) << "whole numbers stay whole";
  const SweepPlan none = plan_of(axes, {});
  EXPECT_EQ(count_groups(none), none.cells);
  expect_covered(none);
  // 65,536 / 1,000 / 9 rounds down to 7 of the last axis.
  const SweepPlan large = plan_of({"shadow.constant-bias=0:1:1000", "shadow.slope-bias=0:1:9", "truth.spp=1:20:20"},
                                  {"shadow.constant-bias", "shadow.slope-bias", "truth.spp"});
  EXPECT_EQ(count_groups(large), 3u);
  EXPECT_EQ(group_at(large, 0).inner[2].values.size(), 7u);
  expect_covered(large);
}

TEST(SweepPlan, A_group_is_cut_into_as_many_equal_parts_as_wanted_and_no_more_than_it_has_cells) {
  for (const std::size_t parts : {1u, 2u, 3u, 4u, 5u, 7u, 12u, 100u}) {
    SweepPlan plan = plan_of({"shadow.resolution=1,2", "shadow.constant-bias=0:1:5", "shadow.slope-bias=0:1:3"});
    cut_groups(plan, parts);
    EXPECT_EQ(count_groups(plan), 2 * parts_of_group(plan));
    EXPECT_GE(parts_of_group(plan), std::min<std::size_t>(parts, 15));
    expect_covered(plan);
  }
  SweepPlan slopes_first = plan_of({"shadow.constant-bias=0:1:5", "shadow.slope-bias=0:1:3"});
  cut_groups(slopes_first, 3);
  EXPECT_EQ(group_at(slopes_first, 0).inner[0].values.size(), 5u) << "one pass takes all constant biases";
}

TEST(SweepPlan, Neighbouring_parts_of_a_group_are_measured_in_one_pass) {
  SweepPlan plan = plan_of({"shadow.resolution=1,2", "shadow.constant-bias=0:1:5", "shadow.slope-bias=0:1:3"});
  const std::size_t whole = count_groups(plan);
  cut_groups(plan, 15);
  std::vector<std::size_t> sizes;
  const auto joined = [&](std::size_t first, std::size_t count) {
    sizes.clear();
    std::set<std::size_t> cells;
    std::set<std::size_t> expected;
    for_each_joined_group(plan, first, count, [&](const CellGroup& group) {
      sizes.push_back(group.size());
      for (std::size_t place = 0; place < group.size(); ++place) {
        EXPECT_EQ(values_at(group, place), grid_values(plan, group.cell(place)));
        EXPECT_TRUE(cells.insert(group.cell(place)).second);
      }
    });
    for (std::size_t g = first; g < first + count; ++g) expected.insert(group_at(plan, g).cell(0));
    EXPECT_EQ(cells, expected);
  };
  joined(0, 30);
  EXPECT_EQ(sizes, std::vector<std::size_t>(whole, 15));
  joined(3, 20);  // two constant biases of the first slope, two whole slopes; then the next resolution's first slope
  EXPECT_EQ(sizes, (std::vector<std::size_t>{2, 10, 5, 3}));
}

TEST(SweepPlan, Empty_and_repeated_axes_are_refused) {
  Sample sample;
  const Parameters parameters = describe(sample);
  const SweepAxis bias = parse_axis(parameters, "shadow.constant-bias=0:1:3");
  EXPECT_THROW(plan_sweep(parameters, {bias, bias}, cost_of_change), Error);
  EXPECT_THROW(plan_sweep(parameters, {{"shadow.constant-bias", "", {}}}, cost_of_change), Error);
  EXPECT_THROW(plan_sweep(parameters, {{"shadow.unknown", "1", {1.0}}}, cost_of_change), Error);
}

}  // namespace
}  // namespace umbrameter
