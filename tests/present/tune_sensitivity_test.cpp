#include "present/tune_sensitivity.h"

#include <gtest/gtest.h>

#include "experiments/settings/experiment.h"
#include "tests/support/expect_words.h"

namespace umbrameter {
namespace {

TunePoint point(double radius, double cost) {
  TunePoint each{{radius}, {}, {}};
  each.score.cost = cost;
  return each;
}

TEST(TuneSensitivity, A_point_beside_the_search_that_is_better_than_its_best_one_is_named) {
  Experiment experiment;
  TuneSummary summary;
  summary.axes = {parse_tune_axis(describe(experiment), "ao.radius", "0.1:2:log")};
  summary.goal = make_goal("mae", {}, "ao", summary.axes, false);
  summary.result.best = point(1.0, 0.05);
  summary.result.scans = {{0, {point(0.5, 0.07), point(1.0, 0.05), point(1.5, 0.06)}}};
  EXPECT_TRUE(missed_points(summary).empty());
  summary.result.scans[0].points.push_back(point(1.75, 0.04));
  ASSERT_EQ(missed_points(summary).size(), 1u);
  expect_words(missed_points(summary)[0], {"ao.radius: the search missed 1.75 m", "--evaluations"});
}

}  // namespace
}  // namespace umbrameter
