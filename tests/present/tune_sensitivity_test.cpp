#include "present/tune_sensitivity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "experiments/settings/experiment.h"
#include "present/presentation_parts.h"
#include "present/tune_comparison.h"
#include "present/tune_text.h"
#include "tests/support/expect_words.h"

namespace umbrameter {
namespace {

TunePoint point(double radius, double cost) {
  TunePoint each{{radius}, {}, {}};
  each.score.cost = cost;
  return each;
}

TuneSummary summary_of(const char* key, const char* range, const char* kind, const TunePoint& best) {
  Experiment experiment;
  TuneSummary summary;
  summary.axes = {parse_tune_axis(describe(experiment), key, range)};
  summary.goal = make_goal("mae", {}, kind, summary.axes, false);
  summary.result.best = best;
  return summary;
}

TEST(TuneSensitivity, A_point_beside_the_search_that_is_better_than_its_best_one_is_named) {
  TuneSummary summary = summary_of("ao.radius", "0.1:2:log", "ao", point(1.0, 0.05));
  summary.result.scans = {{0, {point(0.5, 0.07), point(1.0, 0.05), point(1.5, 0.06)}}};
  EXPECT_TRUE(missed_points(summary).empty());
  summary.result.scans[0].points.push_back(point(1.75, 0.04));
  ASSERT_EQ(missed_points(summary).size(), 1u);
  expect_words(missed_points(summary)[0], {"ao.radius: the search missed 1.75 m", "--evaluations"});
}

TEST(TuneSensitivity, Of_an_axis_of_many_whole_numbers_the_measured_ones_are_named) {
  const auto at = [](std::int64_t resolution, double cost) {
    TunePoint each{{resolution}, {}, {}};
    each.score.cost = cost;
    return each;
  };
  TuneSummary summary = summary_of("shadow.resolution", "256:2048:log", "shadow", at(2037, 0.01));
  summary.result.limit = {0.0105};
  summary.result.scans = {{0, {at(1947, 0.012), at(2037, 0.01), at(2048, 0.011)}}};
  EXPECT_EQ(to_string(sensitivity_table(summary).rows[0][3]),
            "2037 texels (the next measured values, 1947 and 2048 texels, are outside)");
}

TEST(TuneFront, A_table_of_a_long_front_has_the_best_point_and_says_how_many_it_leaves_out) {
  TuneSummary summary = summary_of("shadow.slope-bias", "0:4", "shadow", point(0.0, 0.0));
  std::vector<TunePoint> front;
  for (int i = 0; i < 100; ++i) front.push_back(TunePoint{{0.01 * i}, {{0.01}}, {}});
  for (std::size_t best = 0; best < front.size(); ++best) {
    summary.result.best = front[best];
    const ReportTable table = front_table(summary, front);
    const auto has_best = [&](const std::vector<Value>& row) {
      return to_string(row[0]) == value_text(summary.axes[0], front[best].values[0]);
    };
    EXPECT_TRUE(std::ranges::any_of(table.table.rows, has_best)) << best;
    ASSERT_EQ(table.remarks.size(), 1u);
    EXPECT_EQ(table.remarks[0].find(std::to_string(table.table.rows.size()) + " of the front's 100 points"), 0u);
  }
  front.resize(10);
  EXPECT_TRUE(front_table(summary, front).remarks.empty());
}

TEST(TuneComparison, A_word_without_a_cost_says_why) {
  TuneSummary summary = summary_of("shadow.filter", "nearest,box", "shadow", {{std::string("nearest")}, {}, {}});
  TunePoint none{{std::string("box")}, {}, {}};
  none.score.cost = std::numeric_limits<double>::quiet_NaN();
  summary.judgement.compared = {{0, summary.result.best, {}, {}, true}, {0, none, {}, {}}};
  EXPECT_NE(ranking_lines(summary).at(0).find("box — (no such value in every case)"), std::string::npos)
      << ranking_lines(summary).at(0);
}

TEST(TuneComparison, What_a_word_does_not_read_is_no_part_of_its_best_point) {
  TuneSummary summary = summary_of("shadow.filter-size", "3,5,7", "shadow", point(3.0, 0.05));
  const TunePoint of_disk = point(5.0, 0.06);
  summary.result.of_words = {{0, of_disk, {"shadow.filter-size"}}};
  summary.shown = summary.goal;
  summary.judgement.compared = {{{}, point(3.0, 0.05), {{0.05}}, {}}, {0, of_disk, {{0.06}}, {}}};
  const Table table = comparison_table(summary);
  EXPECT_EQ(to_string(table.rows.at(0).back()), "3 texels");
  EXPECT_EQ(to_string(table.rows.at(1).back()), "—");
}

// Three of 1,000 counted pixels are 0.3 %, whatever case they are of.
TEST(TuneSensitivity, A_range_by_pixels_is_a_share_of_them_where_several_cases_are_averaged) {
  TuneSummary summary = summary_of("shadow.slope-bias", "0:4", "shadow", point(2.0, 0.001));
  summary.result.limit = limit_of_plateau(0.001, 1000);
  summary.result.scans = {{0, {point(0.0, 0.1), point(2.0, 0.001), point(4.0, 0.0035)}}};
  summary.cases = {"sun"};
  const Table of_one = sensitivity_table(summary);
  EXPECT_EQ(of_one.columns[3].name, "within 3 wrong pixels");
  EXPECT_EQ(to_string(of_one.rows[0][3]),
            "2 to 4 texels (upper end of the axis) (the next measured value, 0 texels, is outside)");
  summary.cases = {"sun", "lamp"};
  EXPECT_EQ(sensitivity_table(summary).columns[3].name,
            "within 0.30 percentage points (three wrong pixels of all cases)");
}

}  // namespace
}  // namespace umbrameter
