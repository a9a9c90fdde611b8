#include <gtest/gtest.h>

#include <algorithm>

#include "experiments/measure/metric_scores.h"
#include "results/known_statistics.h"

namespace umbrameter {
namespace {

TEST(MetricColumns, The_error_that_is_not_corrected_for_noise_has_a_name_of_its_own) {
  for (const char* name : {"rmse", "rmse-uncorrected", "rmse,rmse-uncorrected"}) {
    RunParams run;
    run.metrics = name;
    const std::vector<MetricColumn> columns = metric_columns(run, false);
    ASSERT_EQ(columns.size(), 1u) << name;
    EXPECT_EQ(columns.front().name, "rmse-uncorrected");
  }
  EXPECT_EQ(metric_to_measure("rmse-uncorrected"), "rmse");
  EXPECT_EQ(metric_to_measure("rmse"), "") << "a statistic, measured anyway";
  const auto& known = known_statistics();
  EXPECT_EQ(std::count_if(known.begin(), known.end(),
                          [](const KnownStatistic& each) { return each.kind == "ao" && each.name == "rmse"; }),
            1);
}

}  // namespace
}  // namespace umbrameter
