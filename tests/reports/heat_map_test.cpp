#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "reports/figures/figure_parts.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

// 17 biases × 4 slopes × 3 resolutions; the cell of least error of each resolution is marked.
HeatMapFigure bias_map() {
  HeatMapFigure figure;
  figure.stem = "heat";
  figure.title = "Mean absolute error";
  figure.x = {"bias", "constant bias [m]"};
  figure.y = {"slope", "slope bias [texels]"};
  figure.value = {"mae", "mean absolute error [%]"};
  figure.panel = "resolution";
  figure.panel_label = "resolution [texels]";
  figure.mark = "least";
  figure.data.columns = {
      {"bias", "m", ""}, {"slope", "texels", ""}, {"resolution", "texels", ""}, {"mae", "%", ""}, {"least", "", ""}};
  for (const int resolution : {512, 1024, 2048}) {
    for (int slope = 0; slope < 4; ++slope) {
      for (int i = 0; i < 17; ++i) {
        const double miss = 0.01 * i - 20.0 / resolution + 0.01 * slope;
        figure.data.rows.push_back(
            {0.01 * i, std::int64_t{slope}, std::int64_t{resolution}, 5000.0 * miss * miss, i == 2 && slope == 1});
      }
    }
  }
  return figure;
}

PlotFigure causes_plot() {
  PlotFigure figure;
  figure.stem = "causes";
  figure.title = "Acne and peter-panning";
  figure.x = {"bias", "constant bias [m]", true};
  figure.y = {"share", "share [%]", false, true};
  figure.series = "resolution";
  figure.series_label = "resolution [texels]";
  figure.style = "cause";
  figure.style_label = "cause";
  figure.mark = "knee";
  figure.data.columns = {
      {"bias", "m", ""}, {"share", "%", ""}, {"resolution", "texels", ""}, {"cause", "", ""}, {"knee", "", ""}};
  for (const int resolution : {512, 1024}) {
    for (int i = 0; i < 30; ++i) {
      const double bias = 0.01 * i;
      figure.data.rows.push_back(
          {bias, 40.0 * std::exp(-0.02 * bias * resolution), std::int64_t{resolution}, std::string("acne"), false});
      figure.data.rows.push_back({bias, 3.0 * bias, std::int64_t{resolution}, std::string("peter-panning"), i == 9});
    }
  }
  return figure;
}

TEST(HeatMap, Is_drawn_with_and_without_panels_and_beside_plots) {
  const TemporaryFolder folder;
  HeatMapFigure single = bias_map();
  single.stem = "single";
  single.panel.reset();
  single.x.logarithmic = true;
  std::erase_if(single.data.rows, [](const std::vector<Value>& row) { return to_string(row[2]) != "512"; });
  const std::vector<std::string> problems = write_figures(folder / "figures", {causes_plot(), bias_map(), single});
  EXPECT_TRUE(problems.empty()) << problems.front();
  EXPECT_EQ(count_files(folder / "figures"), 9u);
}

// The svg of bias_map() whose panel column holds these values.
std::string svg_with_panels(const std::vector<Value>& panels) {
  const TemporaryFolder folder;
  HeatMapFigure figure = bias_map();
  const std::vector<std::string> resolutions = {"512", "1024", "2048"};
  for (std::vector<Value>& row : figure.data.rows) {
    const auto found = std::find(resolutions.begin(), resolutions.end(), to_string(row[2]));
    row[2] = panels[static_cast<std::size_t>(found - resolutions.begin())];
  }
  EXPECT_TRUE(write_figures(folder / "figures", {figure}).empty());
  return text_of(folder / "figures/heat.svg");
}

TEST(HeatMap, Panels_of_words_are_titled_with_the_words) {
  const std::string svg = svg_with_panels({std::string("nearest"), std::string("box"), std::string("true")});
  for (const char* title : {">nearest</text>", ">box</text>", ">true</text>"}) {
    EXPECT_NE(svg.find(title), std::string::npos) << title;
  }
  EXPECT_EQ(svg.find("NaN"), std::string::npos);
}

TEST(HeatMap, Panels_of_numbers_are_titled_with_four_digits) {
  const std::string svg = svg_with_panels({0.123456, 2.0, std::int64_t{4096}});
  for (const char* title : {">0.1235</text>", ">2</text>", ">4096</text>"}) {
    EXPECT_NE(svg.find(title), std::string::npos) << title;
  }
}

TEST(HeatMap, Cells_meet_half_way_and_the_first_begins_at_zero) {
  HeatMapFigure figure = bias_map();
  figure.panel.reset();
  figure.mark.reset();
  figure.data.rows = {{0.0, std::int64_t{1}, std::int64_t{1}, 1.0, false},
                      {0.2, std::int64_t{1}, std::int64_t{1}, 1.0, false},
                      {0.6, std::int64_t{1}, std::int64_t{1}, 1.0, false}};
  const Json cells = Json::parse(to_plot_specification(figure))["data"]["values"];
  ASSERT_EQ(cells.size(), 3u);
  EXPECT_DOUBLE_EQ(cells[0]["x"], 0.0);
  EXPECT_DOUBLE_EQ(cells[0]["x2"], 0.1);
  EXPECT_DOUBLE_EQ(cells[1]["x2"], 0.4);
  EXPECT_DOUBLE_EQ(cells[2]["x2"], 0.8);
  figure.x.logarithmic = true;
  figure.data.rows[2][0] = 0.8;
  const Json specification = Json::parse(to_plot_specification(figure));
  // Between 0.2 and 0.8 the geometric middle is 0.4, as far below 0.8 as 1.6 is above it.
  ASSERT_EQ(specification["data"]["values"].size(), 2u);
  EXPECT_NEAR(specification["data"]["values"][0]["x"].get<double>(), 0.1, 1e-12);
  EXPECT_NEAR(specification["data"]["values"][0]["x2"].get<double>(), 0.4, 1e-12);
  EXPECT_NEAR(specification["data"]["values"][1]["x2"].get<double>(), 1.6, 1e-12);
  EXPECT_EQ(specification["title"]["text"].back(), "Not shown: 1 of 3 cells at 0 or without a number.");
}

// Of 1000 cells between 2 and 3 %, which are one colour between steps of 1, 2 and 5.
TEST(HeatMap, Cells_near_the_least_error_have_colours_of_their_own_whatever_the_range) {
  HeatMapFigure figure = bias_map();
  figure.panel.reset();
  figure.data.rows.clear();
  for (int i = 0; i < 1000; ++i) {
    figure.data.rows.push_back({0.001 * (i % 100), std::int64_t{i / 100}, std::int64_t{512}, 2.0 + 0.001 * i, i == 0});
  }
  const Json specification = Json::parse(to_plot_specification(figure));
  const std::string label = specification["layer"][0]["encoding"]["color"]["legend"]["labelExpr"];
  // 2, 5, 10, 20, 30, 45, 60, 75 and 90 % of the cells lie below.
  EXPECT_EQ(label, "' ' + ['', 2.02, 2.05, 2.1, 2.2, 2.3, 2.45, 2.6, 2.75, 2.9][datum.value] + ' '");
  const Json& cells = specification["data"]["values"];
  EXPECT_EQ(specification["layer"][0]["encoding"]["color"]["scale"]["type"], "threshold");
  EXPECT_EQ(cells[19]["v"], 0);
  EXPECT_EQ(cells[20]["v"], 1) << "a step begins at its value";
  EXPECT_EQ(cells[21]["v"], 1);
  EXPECT_EQ(cells[999]["v"], 9);
}

// 0.0137, 0.1507, 0.2877 …: of 100 cells, 2, 5, 10, 20, 30, 45, 60, 75 and 90 lie below the steps.
TEST(HeatMap, Steps_have_two_digits_where_these_tell_them_apart) {
  HeatMapFigure figure = bias_map();
  figure.panel.reset();
  figure.data.rows.clear();
  for (int i = 0; i < 100; ++i) {
    figure.data.rows.push_back({0.1 * i, std::int64_t{0}, std::int64_t{512}, 0.0137 + 0.137 * i, i == 0});
  }
  const Json specification = Json::parse(to_plot_specification(figure));
  const std::string label = specification["layer"][0]["encoding"]["color"]["legend"]["labelExpr"];
  EXPECT_EQ(label, "' ' + ['', 0.29, 0.7, 1.4, 2.8, 4.1, 6.2, 8.2, 10, 12][datum.value] + ' '");
}

TEST(HeatMap, Equal_cells_have_one_colour) {
  HeatMapFigure figure = bias_map();
  for (std::vector<Value>& row : figure.data.rows) row[3] = 0.5;
  const Json specification = Json::parse(to_plot_specification(figure));
  EXPECT_EQ(specification["spec"]["layer"][0]["encoding"]["color"]["scale"]["domain"], Json({1}));
  for (const Json& cell : specification["data"]["values"]) EXPECT_EQ(cell["v"], 0);
}

TEST(HeatMap, Panels_fill_their_rows_where_they_can) {
  HeatMapFigure figure = bias_map();
  EXPECT_EQ(Json::parse(to_plot_specification(figure))["columns"], 3);
  std::vector<Value> row = figure.data.rows.front();
  row[static_cast<std::size_t>(column_index(figure.data, *figure.panel))] = std::int64_t{4096};
  figure.data.rows.push_back(row);
  const Json specification = Json::parse(to_plot_specification(figure));
  EXPECT_EQ(specification["columns"], 2);
  EXPECT_FALSE(specification.contains("resolve"));
}

TEST(HeatMap, Rows_stand_with_the_largest_on_top) {
  const Json specification = Json::parse(to_plot_specification(bias_map()));
  EXPECT_EQ(specification["spec"]["layer"][0]["encoding"]["y"]["scale"]["domain"], Json({"3", "2", "1", "0"}));
  EXPECT_EQ(specification["facet"]["sort"], Json({"512", "1024", "2048"}));
}

TEST(HeatMap, One_value_and_none_are_drawn_too) {
  const TemporaryFolder folder;
  HeatMapFigure one = bias_map();
  one.data.rows.resize(1);
  HeatMapFigure none = bias_map();
  none.stem = "none";
  none.data.rows.clear();
  const std::vector<std::string> problems = write_figures(folder / "figures", {one, none});
  EXPECT_TRUE(problems.empty()) << problems.front();
  EXPECT_EQ(count_files(folder / "figures"), 6u);
}

TEST(HeatMap, A_missing_column_is_named) {
  HeatMapFigure figure = bias_map();
  figure.value.column = "rmse";
  EXPECT_THROW(to_plot_specification(figure), Error);
}

TEST(PlotMarks, Are_rings_and_no_part_of_a_line) {
  const Json layers = Json::parse(to_plot_specification(causes_plot()))["layer"];
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_EQ(layers[0]["mark"]["type"], "line");
  EXPECT_EQ(layers[0]["transform"][0]["filter"], "!datum.k");
  EXPECT_EQ(layers[1]["transform"][0]["filter"], "datum.k");
  EXPECT_EQ(layers[0]["encoding"]["strokeDash"]["scale"]["domain"], Json({"acne", "peter-panning"}));
}

TEST(PlotFigure, A_value_with_a_colour_of_its_own_keeps_its_dashes_where_others_are_missing) {
  const auto dashes_of_last = [](const std::vector<std::string>& names) {
    PlotFigure figure;
    figure.stem = "parts";
    figure.x = {"x", "x"};
    figure.y = {"y", "y"};
    figure.series = "part";
    figure.series_colors = {{"acne", {1, 2, 3}}, {"panning", {4, 5, 6}}, {"leak", {7, 8, 9}}};
    figure.data.columns = {{"x", "", ""}, {"y", "", ""}, {"part", "", ""}};
    for (const std::string& name : names) {
      for (const double x : {1.0, 2.0}) figure.data.rows.push_back({x, x, name});
    }
    Json dashes;
    const Json specification = Json::parse(to_plot_specification(figure));
    for (const Json& layer : specification["layer"]) {
      if (layer["encoding"].contains("strokeDash")) dashes = layer["encoding"]["strokeDash"]["scale"]["range"].back();
    }
    return dashes;
  };
  EXPECT_FALSE(dashes_of_last({"leak"}).is_null());
  EXPECT_EQ(dashes_of_last({"acne", "leak"}), dashes_of_last({"acne", "panning", "leak"}));
}

}  // namespace
}  // namespace umbrameter
