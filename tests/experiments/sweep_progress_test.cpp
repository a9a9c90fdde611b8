#include "experiments/sweep/sweep_progress.h"

#include <gtest/gtest.h>

namespace umbrameter {
namespace {

TEST(SweepProgress, Cells_alone_are_all_of_the_work_where_nothing_is_traced) {
  SweepProgress progress{4};
  for (const double cells : {0.0, 0.1, 0.25, 0.6, 1.0}) {
    advance_cells(progress, cells);
    EXPECT_DOUBLE_EQ(progress.share, cells);
  }
}

TEST(SweepProgress, The_tracing_of_a_reference_counts_as_much_as_its_cells) {
  // Two references. Each is half of the work, the first half of that its tracing.
  SweepProgress progress{2};
  advance_cells(progress, 0.0);
  advance_tracing(progress, 0.5);
  EXPECT_DOUBLE_EQ(progress.share, 0.125);
  advance_tracing(progress, 1.0);
  EXPECT_DOUBLE_EQ(progress.share, 0.25);
  advance_cells(progress, 0.25);
  EXPECT_DOUBLE_EQ(progress.share, 0.375);
  advance_cells(progress, 0.5);
  EXPECT_DOUBLE_EQ(progress.share, 0.5);
  advance_tracing(progress, 0.5);
  EXPECT_DOUBLE_EQ(progress.share, 0.625);
  advance_tracing(progress, 1.0);
  advance_cells(progress, 1.0);
  EXPECT_DOUBLE_EQ(progress.share, 1.0);
}

TEST(SweepProgress, Never_falls_and_ends_at_one_when_more_is_traced_than_was_counted) {
  SweepProgress progress{1};
  double before = 0.0;
  for (int cell = 0; cell < 10; ++cell) {
    for (const double traced : {0.01, 0.5, 1.0}) {
      advance_tracing(progress, traced);
      EXPECT_GE(progress.share, before);
      before = progress.share;
    }
    advance_cells(progress, 0.1 * (cell + 1));
    EXPECT_GE(progress.share, before);
    before = progress.share;
  }
  EXPECT_DOUBLE_EQ(progress.share, 1.0);
}

TEST(SweepProgress, Axes_of_the_light_the_view_and_the_reference_ask_for_references) {
  SweepPlan plan;
  const auto axis = [](const char* key, std::size_t values) {
    return SweepAxis{key, "", std::vector<Value>(values, Value(1.0))};
  };
  plan.axes = {axis("shadow.constant-bias", 65), axis("shadow.resolution", 3)};
  EXPECT_EQ(count_references(plan), 1u);
  plan.axes.push_back(axis("light.angle", 2));
  plan.axes.push_back(axis("truth.spp", 4));
  EXPECT_EQ(count_references(plan), 8u);
}

}  // namespace
}  // namespace umbrameter
