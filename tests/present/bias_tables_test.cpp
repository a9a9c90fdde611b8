// Tables and answer of a sweep over biases, on curves that are made here.
#include <gtest/gtest.h>

#include <algorithm>

#include "present/bias_report.h"
#include "present/plot_axes.h"

namespace umbrameter {
namespace {

// Seventeen biases from 5 mm on, 3.203125 mm apart; the least error is at 5.625 cm.
BiasCurves fine_curves() {
  BiasCurves curves;
  curves.varies_constant = curves.varies_slope = true;
  for (int i = 0; i <= 16; ++i) curves.constants.push_back(0.005 + 0.003203125 * i);
  BiasCurve curve;
  curve.optima.mean_texel = 0.032;
  BiasLine line;
  line.slope = 0.5625;
  line.least_error = BiasCell{curves.constants.back(), 0.5625, 0.01};
  line.little_acne = line.acne_free = BiasCell{0.053046875, 0.5625, 0.0125};
  curve.optima.lines.push_back(line);
  curves.curves.push_back(curve);
  curves.combinations = 1;
  return curves;
}

std::string cell_of(const Table& table, std::size_t row, const char* column) {
  return to_string(table.rows.at(row)[column_index(table, column)]);
}

TEST(BiasTables, Values_of_an_axis_are_printed_as_given_and_what_follows_from_them_in_three_digits) {
  const BiasCurves curves = fine_curves();
  Presentation presentation;
  present_bias(presentation, curves);
  const Table& choices = presentation.section.tables.at(0).table;
  EXPECT_EQ(cell_of(choices, 1, "constant bias"), "0.05625");
  EXPECT_EQ(cell_of(choices, 1, "in texels"), "1.76");
  EXPECT_EQ(cell_of(choices, 1, "slope bias"), "0.5625");
  const Table& slopes = presentation.section.tables.at(1).table;
  EXPECT_EQ(cell_of(slopes, 0, "at"), "0.05625");
  ASSERT_EQ(presentation.answers.size(), 1u);
  EXPECT_EQ(presentation.answers[0], "least error 1.00 % at 5.625 cm (1.76 texels), slope-scaled bias 0.5625 texels");
}

// 1 cm leaves acne on 0.2 %, 3 cm on 0.08 % with an error outside the range of good ones.
TEST(BiasTables, Where_every_good_bias_leaves_acne_the_answer_names_the_first_that_does_not) {
  BiasCurves curves = fine_curves();
  BiasCurve& curve = curves.curves[0];
  const BiasCell best{0.01, 0.5625, 0.0100, 0.002};
  const BiasCell clean{0.053046875, 0.5625, 0.0125, 0.0008};
  curve.plateau = plateau_of(std::vector<BiasCell>{best, clean});
  const auto answer = [&] {
    Presentation presentation;
    present_bias(presentation, curves);
    return presentation.answers.at(0);
  };
  EXPECT_NE(answer().find(": error 1.00 %, acne 0.200 %; "), std::string::npos) << answer();
  EXPECT_NE(
      answer().find("; acne is at most 0.1 % from the swept bias 5.3 cm (1.66 texels) on, where the error is 1.25 %"),
      std::string::npos)
      << answer();
  curve.optima.lines[0].little_acne.reset();
  EXPECT_NE(answer().find("; acne is more than 0.1 % at every swept bias"), std::string::npos) << answer();
}

TEST(BiasTables, Why_no_bias_is_recommended_stands_in_the_answers_or_below_the_table) {
  BiasCurves curves = fine_curves();
  curves.others = {{"camera", "", ""}};
  const BiasCurve first = curves.curves[0];
  curves.curves.clear();
  for (int camera = 0; camera < 9; ++camera) {
    BiasCurve curve = first;
    curve.others = {std::int64_t{camera}};
    curve.plateau = plateau_of(std::vector<BiasCell>{{0.01, 0.5625, 0.0100, 0.0}});
    curve.evidence.pixels = 10 + static_cast<std::uint64_t>(camera);
    curve.withheld = NoBias::few_pixels;
    curves.curves.push_back(curve);
  }
  Presentation presentation;
  present_bias(presentation, curves);
  std::string said;
  for (const std::string& answer : presentation.answers) said += answer + "\n";
  for (const std::string& remark : presentation.section.tables.at(0).remarks) said += remark + "\n";
  for (int camera = 0; camera < 9; ++camera) {
    const std::string reason =
        "camera " + std::to_string(camera) + ": no bias recommended: only " + std::to_string(10 + camera);
    EXPECT_NE(said.find(reason), std::string::npos) << reason << "\n" << said;
  }
}

TEST(BiasTables, A_difference_of_shares_is_in_percentage_points) {
  Presentation presentation;
  present_bias(presentation, fine_curves());
  for (const char* name : {"extra error", "extra peter-panning"}) {
    const Table& table = presentation.section.tables.at(0).table;
    EXPECT_EQ(table.columns[column_index(table, name)].unit, "percentage points");
    EXPECT_NE(cell_of(table, 2, name), "") << name;
  }
}

TEST(PlotAxes, A_value_has_the_digits_that_it_was_given_with) {
  const std::vector<double> axis = {0.05, 0.05625, 0.0625, 0.06875};
  EXPECT_EQ(digits_on_axis(axis, 0.05625), 4);
  EXPECT_EQ(digits_of_step(axis, 0.05625), 3);
  EXPECT_EQ(digits_on_axis(axis, 0.0625), 3);
  EXPECT_EQ(digits_on_axis({0.01, 0.0171, 0.029240177382}, 0.029240177382), 3) << "computed";
}

TEST(PlotAxes, A_number_without_a_unit_has_no_bracket) {
  SweepAxis axis;
  axis.key = "ao.power";
  axis.unit = "1";
  EXPECT_EQ(label_of(axis), "power");
  axis.key = "shadow.constant-bias";
  axis.unit = "m";
  EXPECT_EQ(label_of(axis), "constant bias [m]");
}

}  // namespace
}  // namespace umbrameter
