#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "reports/figures/figure_parts.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

WaterfallFigure three_steps() {
  WaterfallFigure figure;
  figure.stem = "waterfall";
  figure.title = "Error by stage";
  figure.conditions = "method, radius 0.5 m";
  figure.label = "technique − reference [1]";
  figure.below = "darkens";
  figure.above = "brightens";
  figure.steps = {{"model", "RMS 0.2", -0.25, -0.26, -0.24}, {"hidden", "", 0.5}, {"blur", "", -0.125}};
  figure.total = {"total", "RMS 0.3", 0.125};
  return figure;
}

TEST(Waterfall, Each_bar_starts_where_the_one_before_ends_and_the_total_at_0) {
  const Json spec = Json::parse(to_plot_specification(three_steps()));
  const Json& rows = spec["data"]["values"];
  ASSERT_EQ(rows.size(), 4u);
  const double from[] = {0.0, -0.25, 0.25, 0.0};
  const double to[] = {-0.25, 0.25, 0.125, 0.125};
  const char* kinds[] = {"darkens", "brightens", "darkens", "total"};
  const char* labels[] = {"−0.25", "+0.50", "−0.12", "+0.12"};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(rows[i]["from"], from[i]) << i;
    EXPECT_EQ(rows[i]["to"], to[i]) << i;
    EXPECT_EQ(rows[i]["kind"], kinds[i]) << i;
    EXPECT_EQ(rows[i]["label"], labels[i]) << i;
  }
  // Only the first has an interval.
  EXPECT_DOUBLE_EQ(rows[0]["lo"].get<double>(), -0.26);
  EXPECT_DOUBLE_EQ(rows[0]["hi"].get<double>(), -0.24);
  EXPECT_FALSE(rows[1].contains("lo"));
}

// The drawing is 280 units high for 0.56 and twice a margin of 8 %; a number needs 18 units.
TEST(Waterfall, Numbers_stand_clear_of_the_zero_line_and_of_the_lines_between_bars) {
  WaterfallFigure figure = three_steps();
  figure.steps = {{"model", "", 0.5}, {"hidden", "", -0.51}, {"thin", "", -0.05}, {"blur", "", 0.01}};
  figure.total = {"total", "", -0.05};
  const Json spec = Json::parse(to_plot_specification(figure));
  const double unit = (0.56 + 2.0 * 0.08 * 0.56) / 280.0;
  for (const Json& row : spec["data"]["values"]) {
    const double at = row["label_at"].get<double>();
    EXPECT_GE(at, row["top"].get<double>());
    for (const double line : {0.0, row["from"].get<double>(), row["to"].get<double>()}) {
      EXPECT_TRUE(line <= at || line >= at + 18.0 * unit) << row << " and " << line;
    }
  }
  // The third bar begins at −0.01, 5 units below the zero line.
  EXPECT_EQ(spec["data"]["values"][2]["label_at"], 0.0);
}

TEST(Waterfall, A_waterfall_becomes_the_three_files_of_a_figure) {
  const TemporaryFolder folder;
  const std::vector<std::string> problems = write_figures(folder / "figures", {three_steps()});
  if (!problems.empty() && problems.front().find("plot not drawn") != std::string::npos) {
    GTEST_SKIP() << problems.front();
  }
  EXPECT_TRUE(problems.empty());
  for (const char* format : {".svg", ".pdf", ".png"}) {
    EXPECT_TRUE(std::filesystem::is_regular_file(folder / ("figures/waterfall" + std::string(format)))) << format;
  }
}

}  // namespace
}  // namespace umbrameter
