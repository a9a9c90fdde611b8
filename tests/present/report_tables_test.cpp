// Tables and intervals of `report` on runs of one light that are made here.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "present/presentation.h"
#include "present/runs_report.h"
#include "reports/files/exr.h"

namespace umbrameter {
namespace {

constexpr int image_side = 64;

// A run of one light with these statistics and layers; all of its pixels are counted.
StoredRun stored_shadow(const std::vector<std::pair<std::string, double>>& statistics,
                        const std::vector<std::pair<std::string, Image<float>>>& layers) {
  StoredRun run;
  run.name = "run";
  run.layers["sun"] = "sun";

  for (const auto& [name, values] : layers) add_layer(run.images, name + "_sun", values);
  add_layer(run.images, "gbuffer_position", Image<vec3>(image_side, image_side, vec3(1.0f)));
  for (const auto& [name, value] : statistics) {
    MeasuredStatistic& measured = run.statistics.emplace_back();
    measured.kind = "shadow";
    measured.light = "sun";
    measured.name = name;
    measured.unit = "1";
    measured.value = value;
  }
  return run;
}

TEST(RunsReportTables, Name_errors_in_words_and_show_too_dark_and_too_bright) {
  const std::vector<StoredRun> runs = {
      stored_shadow({{"lit", 0.5}, {"mae", 0.03}, {"false_blocked", 0.02}, {"false_lit", 0.01}}, {})};
  const std::vector<ComparedStatistic> compared = compare_runs(runs);
  const PartTables part = part_tables(runs, compared).at(0);
  std::vector<std::string> heads;
  for (const Column& column : part.values.columns) heads.push_back(column.name);
  EXPECT_EQ(heads, (std::vector<std::string>{"run", "mean absolute error", "too dark", "too bright"}));
  ASSERT_EQ(part.printed_values.rows.size(), 3u);
  EXPECT_EQ(to_string(part.printed_values.rows[1][0]), "Too dark");
  EXPECT_EQ(to_string(part.all.rows.at(0)[0]), "Share lit in the reference");
  const Table rows = comparison_rows(runs, compared);
  EXPECT_EQ(to_string(rows.rows.at(2)[column_index(rows, "statistic")]), "false_blocked") << "names are for programs";
}

TEST(RunsReportTables, A_printed_difference_names_the_run_that_it_is_to) {
  std::vector<StoredRun> runs = {stored_shadow({{"mae", 0.03}}, {}), stored_shadow({{"mae", 0.05}}, {})};
  runs[0].name = "hard";
  runs[1].name = "box";
  const PartTables part = part_tables(runs, compare_runs(runs)).at(0);
  EXPECT_EQ(part.printed_differences.columns[0].name, "Difference to hard [percentage points]");
  EXPECT_EQ(part.printed_values.columns[0].name, "Error [%]");
}

TEST(RunsReportTables, A_name_of_several_kinds_has_the_words_of_its_kind) {
  StoredRun run = stored_shadow({{"mean_raster", 0.5}}, {});
  run.statistics[0].kind = "ao";
  run.statistics[0].light.clear();
  const std::vector<StoredRun> runs = {run};
  const PartTables part = part_tables(runs, compare_runs(runs)).at(0);
  EXPECT_EQ(to_string(part.all.rows.at(0)[0]), "Mean accessibility of the technique");
}

// Runs of earlier versions hold the main cause of a pixel alone: here 6 % of acne in pixels whose error is 10 %.
TEST(RunsReportIntervals, Causes_of_a_filter_without_their_layers_have_values_and_no_intervals) {
  const Image<float> error(image_side, image_side, -0.1f);
  const Image<float> acne_is_main(image_side, image_side, 1.0f);
  const StoredRun run = stored_shadow({{"mae", 0.1}, {"acne", 0.06}, {"false_occlusion", 0.04}},
                                      {{"error_visibility", error}, {"class", acne_is_main}});
  EXPECT_TRUE(estimate_over_blocks(run, run.statistics[0]));
  EXPECT_FALSE(estimate_over_blocks(run, run.statistics[1]));
  EXPECT_FALSE(estimate_over_blocks(run, run.statistics[2]));
}

// One pixel in a thousand is wrong, all of them in one block: the half width is larger than the error itself.
TEST(RunsReportIntervals, Of_an_absolute_error_ends_at_0_and_of_a_signed_one_does_not) {
  Image<float> error(image_side, image_side, 0.0f);
  for (int i = 0; i < 4; ++i) error[static_cast<std::size_t>(i)] = -1.0f;
  const StoredRun run = stored_shadow({{"mae", 4.0 / 4096.0}, {"mean_error", -4.0 / 4096.0}},
                                      {{"error_visibility", error}, {"class", Image<float>(image_side, image_side)}});
  const std::vector<StoredRun> runs = {run};
  const std::vector<ComparedStatistic> compared = compare_runs(runs);
  const double mae_half_width = compared.at(0).values.at(0).half_width;
  ASSERT_GT(mae_half_width, 4.0 / 4096.0);
  const PartTables part = part_tables(runs, compared).at(0);
  EXPECT_EQ(to_string(part.all.rows.at(0)[3]),
            fmt::format("0.0977 (0.00 to {:.2f})", 100.0 * (4.0 / 4096.0 + mae_half_width)));
  EXPECT_EQ(to_string(part.all.rows.at(1)[3]), fmt::format("−0.1 ± {:.1f}", 100.0 * mae_half_width));
}

TEST(StatisticsTables, Have_words_per_cent_and_the_interval_in_the_cell) {
  const Table rows{{{"ao.radius", "m", ""},
                    {"mae", "1", ""},
                    {"mae_lo", "1", ""},
                    {"mae_hi", "1", ""},
                    {"mean_error", "1", ""},
                    {"pixels", "px", ""}},
                   {{1.25, 0.1154, 0.1134, 0.1174, -0.0123456, std::int64_t{49785}}}};
  const Table shown = in_percent(rows, 1, "ao");
  std::vector<std::string> heads;
  for (const Column& column : shown.columns) heads.push_back(column.name + " " + column.unit);
  EXPECT_EQ(heads, (std::vector<std::string>{"ao.radius m", "mean absolute error %", "mean signed error %",
                                             "pixels that see a surface px"}));
  EXPECT_EQ(shown.rows[0],
            (std::vector<Value>{1.25, std::string("11.54 ± 0.20"), std::string("−1.23"), std::int64_t{49785}}));
}

TEST(StatisticsTables, Give_the_mean_of_the_technique_the_decimals_of_its_difference_to_the_reference) {
  const Table rows{{{"mean_error", "1", ""},
                    {"mean_error_lo", "1", ""},
                    {"mean_error_hi", "1", ""},
                    {"mean_raster", "1", ""},
                    {"max_error", "1", ""}},
                   {{-0.00937, -0.009464, -0.009276, 0.9537961, 0.79412}}};
  EXPECT_EQ(in_percent(rows, 0, "ao").rows[0],
            (std::vector<Value>{std::string("−0.9370 ± 0.0094"), std::string("95.3796"), std::string("79.4")}));
}

TEST(RunsReportTables, A_value_that_stands_for_something_else_is_shown_with_what_it_stands_for) {
  StoredRun own, wide;
  own.name = "own";
  own.parameters = {{"light.angle", "-1"}, {"ao.radius", "1"}};
  wide.name = "wide";
  wide.parameters = {{"light.angle", "2"}, {"ao.radius", "1"}};
  const Table table = differing_parameters({own, wide});
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(to_string(table.rows[0][1]), "-1 (the scene's)");
  EXPECT_EQ(to_string(table.rows[0][2]), "2 degrees");
}

}  // namespace
}  // namespace umbrameter
