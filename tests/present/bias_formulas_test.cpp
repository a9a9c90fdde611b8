// The report of formulas, from curves whose facts and biases are known: (½ + r) · Δz on a plane.
#include "present/bias_formulas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "store/fit_bias_formulas.h"

namespace umbrameter {
namespace {

// A curve on an axis of whole millimetres that is free of acne from `bias` on; least error is there, too.
BiasCurve curve_at(std::vector<Value> others, double texel, double depth_per_texel, double radius, double bias) {
  BiasCurve curve;
  curve.others = std::move(others);
  curve.optima.mean_texel = texel;
  BiasLine line;
  line.least_error = line.acne_free = line.little_acne = BiasCell{bias, 0.0, 0.01};
  curve.optima.lines.push_back(line);
  curve.facts = {depth_per_texel, radius, 1e-6};
  return curve;
}

// Resolution × filter size × normal offset. Texels are 20 m / resolution, at tan θ = 2.
BiasCurves make_curves() {
  BiasCurves curves;
  curves.others = {
      {"shadow.resolution", "texels", ""}, {"shadow.filter-size", "", ""}, {"shadow.normal-offset", "", ""}};
  curves.varies_constant = true;
  for (int mm = 0; mm <= 600; ++mm) curves.constants.push_back(0.001 * mm);
  for (const int resolution : {200, 400, 1000}) {
    for (const int size : {1, 3, 5}) {
      for (const double offset : {0.0, 1.0}) {
        const double texel = 20.0 / resolution;
        const double radius = (size - 1) / 2.0;
        const auto bias = static_cast<std::size_t>(std::lround(1000.0 * (0.5 + radius) * 2.0 * texel));
        curves.curves.push_back(curve_at({std::int64_t{resolution}, std::int64_t{size}, offset}, texel, 2.0 * texel,
                                         radius, curves.constants[bias]));
      }
    }
  }
  curves.combinations = curves.curves.size();
  return curves;
}

TEST(BiasFormulas, Axes_that_change_a_fact_are_in_the_formula_and_others_separate_formulas) {
  BiasCurves curves = make_curves();
  add_formulas(curves);
  ASSERT_EQ(curves.formula_axes.size(), 2u);
  EXPECT_EQ(curves.formula_axes[1].name, "shadow.filter-size");
  ASSERT_EQ(curves.of_a_formula.size(), 1u);
  EXPECT_EQ(curves.of_a_formula[0].name, "shadow.normal-offset");
  ASSERT_EQ(curves.formulas.size(), 6u) << "three biases at each of two offsets";
  for (const CurveFormula& of : curves.formulas) {
    ASSERT_TRUE(of.formula);
    // 5 × 5 taps in texels of 0.1 m need 0.5 m, within the axis; all biases are whole millimetres.
    EXPECT_EQ(of.points.size(), 9u);
    EXPECT_NEAR(of.formula->term(FormulaTerm::slope)->value, 0.5, 1e-9);
    EXPECT_NEAR(of.formula->term(FormulaTerm::slope_radius)->value, 1.0, 1e-9);
    EXPECT_TRUE(of.warnings.empty()) << of.warnings.front();
  }
  EXPECT_EQ(formula_text(*curves.formulas.front().formula).find("bias ≈ (0.50"), 0u)
      << formula_text(*curves.formulas.front().formula);
}

TEST(BiasFormulas, An_axis_that_changes_nothing_is_said_and_its_points_count_once) {
  BiasCurves curves = make_curves();
  const std::vector<BiasCurve> once = curves.curves;
  // The step of the stored depth is a fact, but far below the biases.
  curves.others.push_back({"shadow.depth-format", "", ""});
  curves.curves.clear();
  for (const char* format : {"32f", "24"}) {
    for (BiasCurve curve : once) {
      curve.others.emplace_back(std::string(format));
      curve.facts.depth_step = format == std::string("24") ? 1.1e-6 : 1e-6;
      curves.curves.push_back(curve);
    }
  }
  curves.combinations = curves.curves.size();
  add_formulas(curves);
  ASSERT_FALSE(curves.formulas.empty());
  for (const CurveFormula& of : curves.formulas) {
    ASSERT_TRUE(of.formula);
    ASSERT_FALSE(of.warnings.empty()) << of.points.size();
    EXPECT_NE(of.warnings.front().find("only 9 of 18 points are independent"), std::string::npos)
        << of.warnings.front();
  }
}

TEST(BiasFormulas, Numbers_have_the_digits_that_their_standard_error_justifies) {
  const auto expect_rounded = [](const Fitted& fitted, double value, double error) {
    EXPECT_EQ(rounded(fitted).value, value) << fitted.value;
    EXPECT_EQ(rounded(fitted).standard_error, error) << fitted.value;
  };
  expect_rounded({1.8e-30, 0.00123}, 0.0, 0.0012);
  expect_rounded({0.50137, 0.0123}, 0.501, 0.012);
  expect_rounded({-0.50137, 0.0123}, -0.501, 0.012);
  expect_rounded({1234.5, 567.8}, 1230.0, 570.0);
  expect_rounded({0.004, 0.3}, 0.0, 0.3);
  EXPECT_EQ(rounded({2.5}).value, 2.5);
}

TEST(BiasFormulas, A_term_that_is_zero_within_its_standard_error_is_not_printed) {
  BiasCurves curves = make_curves();
  add_formulas(curves);
  BiasFormula& formula = *curves.formulas.front().formula;
  formula.terms = {Fitted{1.8e-30, 0.0001}, Fitted{0.50137, 0.0123}, Fitted{-0.0004, 0.02}, std::nullopt};
  EXPECT_EQ(formula_text(formula), "bias ≈ 0.501·Δz");
  EXPECT_EQ(formulas_json(curves)[0]["bias_m"], "0.501 * depth_per_texel");
  formula.terms[1] = Fitted{-1e-17, 0.01};
  EXPECT_EQ(formula_text(formula), "bias ≈ 0");
  EXPECT_EQ(formulas_json(curves)[0]["bias_m"], "0");
  formula.terms[0] = Fitted{0.0023, 0.0001};
  EXPECT_EQ(formulas_json(curves)[0]["bias_m"], "0.0023");
}

TEST(BiasFormulas, Only_symbols_that_a_formula_has_are_explained) {
  BiasCurves curves = make_curves();
  add_formulas(curves);
  CurveFormula& first = curves.formulas.front();
  const std::vector<const CurveFormula*> only = {&first};
  first.formula->terms = {Fitted{0.01, 0.001}, Fitted{0.5, 0.01}, std::nullopt, std::nullopt};
  EXPECT_EQ(symbols_text(only).find("Δz: "), 0u);
  EXPECT_EQ(symbols_text(only).find("; r: "), std::string::npos);
  EXPECT_EQ(symbols_text(only).find("δ"), std::string::npos);
  first.formula->terms = {Fitted{0.01, 0.001}, std::nullopt, Fitted{1.0, 0.01}, Fitted{2.0, 0.1}};
  EXPECT_NE(symbols_text(only).find("; r: reach of the filter in texels; δ: "), std::string::npos);
  first.formula->terms = {Fitted{0.01, 0.001}, std::nullopt, std::nullopt, std::nullopt};
  EXPECT_EQ(symbols_text(only), "");
}

TEST(BiasFormulas, The_range_is_said_once_and_the_table_has_heads_in_words) {
  BiasCurves curves = make_curves();
  add_formulas(curves);
  Presentation presentation;
  present_formulas(presentation, curves);
  const std::string& text = presentation.section.text;
  const auto count = [&](const std::string& all, const std::string& part) {
    int found = 0;
    for (std::size_t at = all.find(part); at != std::string::npos; at = all.find(part, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count(text, "Fitted over texel sizes of "), 2) << "once for each offset: " << text;
  EXPECT_EQ(count(text, "fitted over texel sizes of "), 0) << text;
  EXPECT_EQ(count(text, "\n\nFormula ("), 6) << text;
  for (const Figure& figure : presentation.figures) {
    EXPECT_EQ(head_of(figure).caption.find("fitted over"), std::string::npos) << head_of(figure).caption;
  }
  std::vector<std::string> heads;
  for (const Column& column : presentation.section.tables.at(0).table.columns) heads.push_back(column.name);
  for (const char* head : {"constant part", "texel sizes", "filter radius"}) {
    EXPECT_NE(std::ranges::find(heads, head), heads.end()) << head;
  }
  for (const char* head : {"c0", "r", "δ", "texels"}) EXPECT_EQ(std::ranges::find(heads, head), heads.end()) << head;
}

TEST(BiasFormulas, Without_any_point_the_reason_is_said_once) {
  BiasCurves curves = make_curves();
  for (BiasCurve& curve : curves.curves) curve.optima.lines[0].acne_free.reset();
  add_formulas(curves);
  const auto none = std::ranges::find(curves.formulas, FormulaOf::no_acne, &CurveFormula::of);
  ASSERT_NE(none, curves.formulas.end());
  EXPECT_FALSE(none->formula);
  ASSERT_EQ(none->warnings.size(), 1u);
  EXPECT_EQ(none->warnings[0].find("9 of 9 combinations are left out"), 0u) << none->warnings[0];
}

TEST(BiasFormulas, The_figure_has_a_point_for_each_combination_and_what_the_formula_misses_there) {
  BiasCurves curves = make_curves();
  add_formulas(curves);
  const auto figure_of = [](const BiasCurves& of) {
    Presentation presentation;
    present_formulas(presentation, of);
    EXPECT_EQ(presentation.figures.size(), 2u) << "one for each normal offset";
    EXPECT_EQ(presentation.section.tables.back().table.rows.size(), 6u);
    return std::get<PlotFigure>(presentation.figures.at(0));
  };
  const PlotFigure exact = figure_of(curves);
  EXPECT_EQ(exact.data.rows.size(), 3u * 9u);
  for (const std::vector<Value>& row : exact.data.rows) EXPECT_EQ(to_number(row[1]), 0.0) << "the fit is exact";
  EXPECT_EQ(exact.x.label, "measured bias [m]");

  FormulaPoint& point = curves.formulas.front().points.front();
  point.bias += 0.25 * point.texel;
  EXPECT_NEAR(to_number(figure_of(curves).data.rows.front()[1]), -0.25, 1e-6);
}

TEST(BiasFormulas, A_bias_at_the_end_of_the_axis_is_left_out_and_extrapolated) {
  BiasCurves curves = make_curves();
  for (BiasCurve& curve : curves.curves) {
    if (curve.facts.radius == 2.0) curve.optima.lines[0].least_error->constant = curves.constants.back();
  }
  add_formulas(curves);
  const CurveFormula& of = curves.formulas.front();
  EXPECT_EQ(of.of, FormulaOf::least_error);
  EXPECT_EQ(of.left_out, 3u);
  ASSERT_EQ(of.warnings.size(), 3u);
  EXPECT_EQ(of.warnings[0].find("3 of 9 combinations are left out"), 0u) << of.warnings[0];
  EXPECT_EQ(of.warnings[1],
            "of those left out, the formula's range does not reach 3 combinations, one of them resolution 200, "
            "filter-size 5");
  EXPECT_EQ(of.warnings[2].find("r, the filter radius, takes only 2 values"), 0u) << of.warnings[2];
}

TEST(BiasFormulas, Over_the_resolution_alone_a_figure_shows_the_bias_against_the_texel_size) {
  BiasCurves curves = make_curves();
  std::erase_if(curves.curves, [](const BiasCurve& curve) { return curve.facts.radius != 0.0; });
  curves.curves.front().optima.lines[0].acne_free->constant = curves.constants.front();
  add_formulas(curves);
  ASSERT_EQ(curves.formulas.size(), 6u);
  const CurveFormula& of = curves.formulas.front();
  EXPECT_EQ(of.points.size(), 3u);
  EXPECT_NEAR(of.formula->term(FormulaTerm::slope)->value, 0.5, 1e-9);
  EXPECT_NEAR(of.formula->slope.max, 2.0, 1e-12) << "texels: tan θ";
  EXPECT_EQ(curves.formulas[2].left_out, 1u) << "a bias below the axis may have no acne, too";
  Presentation presentation;
  present_formulas(presentation, curves);
  const PlotFigure& figure = std::get<PlotFigure>(presentation.figures.front());
  EXPECT_EQ(figure.stem, "bias_fit_0");
  // Two of three formulas have three points each; of each point the formula's bias and a ring at its own.
  ASSERT_EQ(figure.data.rows.size(), 12u);
  EXPECT_EQ(to_number(figure.data.rows[0][0]), 0.1);
  EXPECT_NEAR(to_number(figure.data.rows[0][1]), to_number(figure.data.rows[1][1]), 1e-9);
}

TEST(BiasFormulas, A_factor_that_is_negative_is_named) {
  BiasCurves curves = make_curves();
  std::erase_if(curves.curves, [](const BiasCurve& curve) { return curve.facts.radius != 0.0; });
  for (BiasCurve& curve : curves.curves)
    curve.optima.lines[0].least_error->constant = 0.2 - 0.5 * curve.facts.depth_per_texel;
  add_formulas(curves);
  const CurveFormula& of = curves.formulas.front();
  ASSERT_TRUE(of.formula);
  EXPECT_LT(of.formula->term(FormulaTerm::slope)->value, 0.0);
  EXPECT_EQ(std::ranges::count_if(
                of.warnings, [](const std::string& text) { return text.find("the factor of Δz is negative") == 0; }),
            1);
}

// Of three filters two have the same reach, and the third has no bias on the axis: a longer one gives no third point.
TEST(BiasFormulas, A_longer_axis_is_advised_only_where_it_can_give_a_formula) {
  const auto advice = [](double radius_of_third) {
    BiasCurves curves;
    curves.others = {{"shadow.filter", "", ""}};
    curves.varies_constant = true;
    for (int mm = 0; mm <= 600; ++mm) curves.constants.push_back(0.001 * mm);
    curves.curves = {curve_at({std::string("a")}, 0.1, 0.2, 0.0, 0.1), curve_at({std::string("b")}, 0.1, 0.2, 1.0, 0.3),
                     curve_at({std::string("c")}, 0.1, 0.2, radius_of_third, 0.6)};
    BiasLine& third = curves.curves[2].optima.lines[0];
    third.little_acne = third.acne_free = std::nullopt;
    curves.combinations = 3;
    add_formulas(curves);
    Presentation presentation;
    present_formulas(presentation, curves);
    EXPECT_FALSE(curves.formulas.front().formula);
    EXPECT_TRUE(presentation.lines.empty()) << "formulas are for the page";
    return presentation.section.text;
  };
  EXPECT_NE(advice(2.0).find("extend the axis of the bias"), std::string::npos) << advice(2.0);
  EXPECT_NE(advice(1.0).find("vary more values"), std::string::npos) << advice(1.0);
}

TEST(BiasFormulas, A_point_is_known_to_within_its_interval_of_the_axis) {
  BiasCurves curves;
  curves.others = {{"shadow.resolution", "texels", ""}};
  curves.constants = {0.0, 0.1, 0.3, 0.4};
  curves.unit = LengthUnit::texels;
  curves.curves = {curve_at({std::int64_t{400}}, 0.05, 0.1, 0.0, 0.1),
                   curve_at({std::int64_t{200}}, 0.1, 0.2, 0.0, 0.3)};
  add_formulas(curves);
  ASSERT_EQ(curves.formulas.size(), 3u);
  const FormulaPoint& least = curves.formulas[0].points[0];
  EXPECT_DOUBLE_EQ(least.texel, 0.05);
  EXPECT_DOUBLE_EQ(least.bias, 0.1 * 0.05);
  EXPECT_DOUBLE_EQ(least.step, 0.5 * (0.3 - 0.0) * 0.05);
  EXPECT_DOUBLE_EQ(curves.formulas[2].points[1].step, (0.3 - 0.1) * 0.1);
}

}  // namespace
}  // namespace umbrameter
