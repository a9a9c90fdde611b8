#include "reports/figures/plot_ticks.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "reports/figures/figure_parts.h"
#include "reports/figures/figures.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

PlotFigure bias_lines(int count) {
  PlotFigure figure;
  figure.stem = "lines";
  figure.x = {"bias", "constant bias [m]"};
  figure.y = {"mae", "mean absolute error [%]"};
  figure.series = "resolution";
  figure.data.columns = {{"bias", "m", ""}, {"mae", "%", ""}, {"resolution", "texels", ""}};
  for (int line = 0; line < count; ++line) {
    for (int i = 0; i < 20; ++i) {
      figure.data.rows.push_back({0.01 * i, 5.0 + i * (line + 1), std::int64_t{256} << line});
    }
  }
  return figure;
}

TEST(PlotTicks, Ticks_of_a_logarithmic_axis_are_1_2_and_5) {
  EXPECT_EQ(log_ticks(0.013, 0.6), (std::vector<double>{0.02, 0.05, 0.1, 0.2, 0.5}));
  EXPECT_EQ(log_ticks(1.0, 100.0), (std::vector<double>{1, 2, 5, 10, 20, 50, 100}));
  EXPECT_EQ(log_ticks(0.001, 10.0), (std::vector<double>{0.001, 0.01, 0.1, 1, 10})) << "eight at most";
  EXPECT_EQ(log_ticks(2.1, 4.9), (std::vector<double>{3, 4})) << "closer than 1, 2 and 5";
  EXPECT_EQ(log_range(0.02, 0.0501).ticks, (std::vector<double>{0.02, 0.03, 0.04, 0.05, 0.06}));
  EXPECT_EQ(log_range(1.222, 2.806).ticks, (std::vector<double>{1, 1.5, 2, 3}));
  EXPECT_EQ(log_range(0.211, 0.233).ticks, (std::vector<double>{0.21, 0.215, 0.22, 0.225, 0.23, 0.235}))
      << "even steps";
  EXPECT_EQ(log_range(0.03, 410.0).ticks, (std::vector<double>{0.03, 0.1, 1, 10, 100, 500})) << "the ends, too";
  EXPECT_EQ(log_range(0.5, 2.8).ticks, (std::vector<double>{0.5, 1, 2, 3})) << "not up to 5";
  EXPECT_EQ(log_range(0.03, 410.0).first, 0.03);
  EXPECT_EQ(log_range(0.03, 410.0).last, 500.0);
  EXPECT_STREQ(log_tick_label({0.001, 1.0, 100.0}), "format(datum.value, '~g')");
  for (const std::vector<double>& ticks : {std::vector<double>{1e-5, 0.1, 100.0}, {1.0, 1e6}}) {
    EXPECT_STREQ(log_tick_label(ticks), "replace(format(datum.value, '~e'), '+', '')") << "1e-5, 1e-1, 1e2";
  }
  PlotFigure figure = bias_lines(2);
  figure.y.logarithmic = true;
  const Json y = Json::parse(to_plot_specification(figure))["layer"][0]["encoding"]["y"];
  // 5 to 43.
  EXPECT_EQ(y["scale"]["domain"], Json({5.0, 50.0}));
  EXPECT_EQ(y["axis"]["values"], Json({5.0, 10.0, 20.0, 50.0}));
}

TEST(PlotTicks, Few_values_of_a_logarithmic_axis_have_a_tick_each) {
  PlotFigure figure = bias_lines(1);
  figure.x = {"resolution", "resolution [texels]", true};
  figure.series.reset();
  figure.data.rows = {{0.0, 5.0, std::int64_t{512}}, {0.0, 3.0, std::int64_t{1024}}, {0.0, 2.0, std::int64_t{4096}}};
  const Json x = Json::parse(to_plot_specification(figure))["encoding"]["x"];
  EXPECT_EQ(x["scale"]["type"], "log");
  EXPECT_EQ(x["axis"]["values"], Json({512.0, 1024.0, 4096.0}));
}

// Where the values are those of a search, ticks at them would say nothing.
TEST(PlotTicks, Values_that_were_not_given_have_round_ticks) {
  PlotFigure figure = bias_lines(1);
  figure.x = {"bias", "constant bias [m]", true};
  figure.x.round_ticks = true;
  figure.series.reset();
  figure.data.rows = {{1.222, 5.0, std::int64_t{512}}, {2.806, 3.0, std::int64_t{512}}, {6.01, 2.0, std::int64_t{512}}};
  const Json x = Json::parse(to_plot_specification(figure))["encoding"]["x"];
  EXPECT_EQ(x["axis"]["values"], Json({1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}));
  EXPECT_EQ(x["scale"]["domain"], Json({1.0, 8.0}));
}

// On a scale of square roots 0.1 of 62 lies at 4 % of the axis, 0.5 at 9 %.
TEST(PlotTicks, A_square_root_axis_has_ticks_near_zero_that_do_not_touch) {
  const std::vector<double> ticks = square_root_range(62.0, 440.0, true).ticks;
  EXPECT_EQ(ticks, (std::vector<double>{0, 0.5, 2, 5, 10, 20, 50, 80}));
  EXPECT_EQ(square_root_range(62.0, 440.0, true).last, 80.0);
  EXPECT_EQ(square_root_range(0.8, 280.0, false).ticks,
            (std::vector<double>{0, 0.005, 0.02, 0.05, 0.1, 0.2, 0.5, 0.8}));
  PlotFigure figure = bias_lines(1);
  figure.y.square_root = true;
  const Json y = Json::parse(to_plot_specification(figure))["layer"][0]["encoding"]["y"];
  EXPECT_EQ(y["scale"]["type"], "sqrt");
  EXPECT_EQ(y["scale"]["domain"], Json({0.0, 30.0}));
  EXPECT_GE(y["axis"]["values"].size(), 6u);
  EXPECT_LE(y["axis"]["values"][1], 0.5);
}

}  // namespace
}  // namespace umbrameter
