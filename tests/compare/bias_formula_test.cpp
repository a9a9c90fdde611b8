// The fit recovers the formula that its points follow. For a plane and a box filter the least bias without acne is
// known: half the depth per texel for the centre, and once more that depth for each texel that the filter reaches.
#include "compare/bias_formula.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace umbrameter {
namespace {

const Fitted& term(const BiasFormula& formula, FormulaTerm which) { return formula.term(which).value(); }

// bias = texel · tan θ · (½ + radius) + 1.5 steps + 1 mm, known to within `noise` of a step of the axis.
std::vector<FormulaPoint> plane(const std::vector<double>& texels, const std::vector<double>& tangents,
                                const std::vector<double>& radii, const std::vector<double>& steps,
                                double noise = 0.0) {
  std::vector<FormulaPoint> points;
  for (const double texel : texels) {
    for (const double tangent : tangents) {
      for (const double radius : radii) {
        for (const double step : steps) {
          const double axis_step = 0.01 * texel;
          const double wave = std::sin(37.0 * static_cast<double>(points.size()));
          const double bias = texel * tangent * (0.5 + radius) + 1.5 * step + 0.001 + noise * wave * axis_step;
          points.push_back({texel, bias, axis_step, {texel * tangent, radius, step}});
        }
      }
    }
  }
  return points;
}

TEST(BiasFormula, Is_found_from_points_that_follow_it) {
  const auto formula = fit_formula(plane({0.01, 0.02, 0.05}, {0.5, 1.7}, {0.0, 1.0, 2.0}, {1e-6, 3e-4}));
  ASSERT_TRUE(formula);
  EXPECT_EQ(formula->points, 36u);
  EXPECT_TRUE(formula->refused.empty());
  EXPECT_NEAR(term(*formula, FormulaTerm::constant).value, 0.001, 1e-9);
  EXPECT_NEAR(term(*formula, FormulaTerm::slope).value, 0.5, 1e-9);
  EXPECT_NEAR(term(*formula, FormulaTerm::slope_radius).value, 1.0, 1e-9);
  EXPECT_NEAR(term(*formula, FormulaTerm::depth_step).value, 1.5, 1e-6);
  EXPECT_LT(formula->residual, 1e-9);
}

TEST(BiasFormula, Noise_below_a_step_of_the_axis_stays_within_the_standard_errors) {
  const auto points = plane({0.01, 0.02, 0.03, 0.05}, {0.5, 1.0, 1.7}, {0.0, 1.0, 2.0}, {1e-6}, 0.5);
  const auto formula = fit_formula(points);
  ASSERT_TRUE(formula);
  const Fitted& slope = term(*formula, FormulaTerm::slope);
  EXPECT_NEAR(slope.value, 0.5, 3.0 * slope.standard_error);
  EXPECT_GT(slope.standard_error, 0.0);
  double squares = 0.0;
  double worst = 0.0;
  for (const FormulaPoint& point : points) {
    const double residual = std::abs(point.bias - bias_of(*formula, point));
    squares += residual * residual;
    worst = std::max(worst, residual);
  }
  EXPECT_NEAR(formula->residual, std::sqrt(squares / static_cast<double>(points.size())), 1e-12);
  EXPECT_EQ(formula->worst_residual, worst);
}

TEST(BiasFormula, A_short_axis_is_refused_by_name) {
  const auto formula = fit_formula(plane({0.01, 0.02, 0.05}, {1.0}, {1.0}, {1e-6}));
  ASSERT_TRUE(formula);
  EXPECT_FALSE(formula->term(FormulaTerm::slope_radius));
  ASSERT_EQ(formula->refused.size(), 2u);
  EXPECT_EQ(formula->refused[0], "filter radius (1 value; at least 2 are needed)");
  EXPECT_EQ(formula->refused[1], "step of the stored depth (1 value; at least 2 are needed)");
}

TEST(BiasFormula, Points_that_repeat_others_do_not_shrink_the_standard_errors) {
  // The second depth format changes δ by 0.01 mm, less than a step of the bias axis, so that δ has no term.
  const auto once = fit_formula(plane({0.01, 0.02, 0.05}, {1.0, 1.7}, {0.0, 1.0}, {1e-6}, 0.5));
  std::vector<FormulaPoint> points = plane({0.01, 0.02, 0.05}, {1.0, 1.7}, {0.0, 1.0}, {1e-6}, 0.5);
  for (std::size_t i = 0; i < 12; ++i) {
    points.push_back(points[i]);
    points.back().facts.depth_step = 1.1e-5;
  }
  const auto twice = fit_formula(points);
  ASSERT_TRUE(once && twice);
  EXPECT_EQ(once->independent, 12u);
  EXPECT_EQ(twice->points, 24u);
  EXPECT_EQ(twice->independent, 12u);
  for (const FormulaTerm t : {FormulaTerm::constant, FormulaTerm::slope, FormulaTerm::slope_radius}) {
    EXPECT_DOUBLE_EQ(term(*twice, t).value, term(*once, t).value);
    EXPECT_DOUBLE_EQ(term(*twice, t).standard_error, term(*once, t).standard_error);
  }
}

TEST(BiasFormula, Points_that_differ_by_chance_alone_count_as_their_mean) {
  std::vector<FormulaPoint> points = plane({0.01, 0.02, 0.05}, {1.0}, {0.0, 1.0}, {1e-6});
  const auto plain = fit_formula(points);
  for (std::size_t i = 0; i < 6; ++i) {
    points.push_back(points[i]);
    points[i].bias += points[i].step;
    points.back().bias -= points[i].step;
  }
  const auto moved = fit_formula(points);
  ASSERT_TRUE(plain && moved);
  EXPECT_EQ(moved->independent, 6u);
  EXPECT_NEAR(term(*moved, FormulaTerm::slope).value, term(*plain, FormulaTerm::slope).value, 1e-9);
  EXPECT_NEAR(term(*moved, FormulaTerm::slope).standard_error, term(*plain, FormulaTerm::slope).standard_error, 1e-9);
}

TEST(BiasFormula, A_depth_step_below_the_step_of_the_axis_is_refused) {
  // The steps of the bias axis are 0.1 mm or more; the stored depths' steps differ by 0.01 mm.
  const auto formula = fit_formula(plane({0.01, 0.02, 0.05}, {1.0}, {0.0, 1.0}, {1e-6, 1.1e-5}));
  ASSERT_TRUE(formula);
  EXPECT_FALSE(formula->term(FormulaTerm::depth_step));
  ASSERT_EQ(formula->refused.size(), 1u);
  EXPECT_NE(formula->refused[0].find("less than one step of the bias axis"), std::string::npos);
}

TEST(BiasFormula, Knows_the_range_that_it_was_fitted_to) {
  const auto formula = fit_formula(plane({0.01, 0.02, 0.05}, {0.5, 1.7}, {0.0, 1.0, 2.0}, {1e-6}));
  ASSERT_TRUE(formula);
  EXPECT_EQ(formula->texel.values, 3u);
  EXPECT_DOUBLE_EQ(formula->depth_per_texel.min, 0.01 * 0.5);
  EXPECT_DOUBLE_EQ(formula->depth_per_texel.max, 0.05 * 1.7);
  EXPECT_DOUBLE_EQ(formula->radius.max, 2.0);
  EXPECT_DOUBLE_EQ(formula->axis_step, 0.01 * 0.02) << "steps are a hundredth of a texel";
  const auto is_outside_at = [&](double depth_per_texel, double radius) {
    return is_outside(*formula, {.facts = {depth_per_texel, radius, 1e-6}});
  };
  EXPECT_FALSE(is_outside_at(0.05, 1.5));
  EXPECT_TRUE(is_outside_at(0.1, 1.5));
  EXPECT_TRUE(is_outside_at(0.05, 3.0));
  // Without a term of the filter its radius does not matter.
  const auto one_radius = fit_formula(plane({0.01, 0.02, 0.05}, {0.5, 1.7}, {1.0}, {1e-6}));
  ASSERT_TRUE(one_radius);
  EXPECT_FALSE(is_outside(*one_radius, {.facts = {0.05, 3.0, 1e-6}}));
}

TEST(BiasFormula, Residual_and_standard_errors_are_those_of_a_straight_line) {
  // Δz 1 2 3 4, bias 1 3 2 4: slope 0.8, intercept 0.5; misses −0.3 0.9 −0.9 0.3, their squares' sum 1.8, s² = 0.9;
  // Sxx = 5: errors √(0.9/5) = 0.4242641 and √(0.9·(1/4 + 2.5²/5)) = 1.1618950; RMS √0.45 = 0.6708204.
  // In texels: −0.3, 0.45, −0.3, 0.075: √(0.388125/4) = 0.3114984. Rounding to the nearest of steps of 1, alike in all
  // points, moves the intercept alone: √(1.35 + 1/12) = 1.1972190.
  const auto formula = fit_formula(std::vector<FormulaPoint>{
      {1, 1, 1, {1, 0, 0}}, {2, 3, 1, {2, 0, 0}}, {3, 2, 1, {3, 0, 0}}, {4, 4, 1, {4, 0, 0}}});
  ASSERT_TRUE(formula);
  const Fitted& slope = term(*formula, FormulaTerm::slope);
  const Fitted& constant = term(*formula, FormulaTerm::constant);
  EXPECT_NEAR(slope.value, 0.8, 1e-14);
  EXPECT_NEAR(slope.standard_error, 0.42426406871192851, 1e-13);
  EXPECT_NEAR(constant.value, 0.5, 1e-14);
  EXPECT_NEAR(constant.standard_error, 1.1972189997378647, 1e-13);
  EXPECT_NEAR(formula->residual, 0.67082039324993691, 1e-13);
  EXPECT_NEAR(formula->residual_texels, 0.31149839485942975, 1e-13);
}

// A least bias without acne of ½ Δz, rounded up to an axis in texels: the same share too large at every resolution.
TEST(BiasFormula, More_points_do_not_average_out_a_rounding_that_they_share) {
  for (const int count : {3, 12, 48}) {
    std::vector<FormulaPoint> points;
    for (int i = 0; i < count; ++i) {
      const double texel = 0.01 * (i + 1);
      points.push_back({texel, 0.727 * 3.0 * texel, 0.255 * 3.0 * texel, {3.0 * texel, 0, 0}});
    }
    const auto formula = fit_formula(points, AxisRounding::up);
    ASSERT_TRUE(formula);
    const Fitted& slope = term(*formula, FormulaTerm::slope);
    EXPECT_NEAR(slope.value, 0.727, 1e-9);
    EXPECT_LT(std::abs(slope.value - 0.5), 2.0 * slope.standard_error) << count;
  }
}

TEST(BiasFormula, A_coarse_interval_counts_less) {
  // Two exact points at b = Δz and one far off whose interval is 1000 times as wide: the line stays at b = Δz.
  const auto formula =
      fit_formula(std::vector<FormulaPoint>{{1, 1, 0.001, {1, 0, 0}}, {2, 2, 0.001, {2, 0, 0}}, {3, 5, 1, {3, 0, 0}}});
  ASSERT_TRUE(formula);
  EXPECT_NEAR(term(*formula, FormulaTerm::slope).value, 1.0, 1e-4);
}

TEST(BiasFormula, Needs_more_points_than_unknowns_and_an_axis) {
  EXPECT_FALSE(fit_formula({}));
  EXPECT_FALSE(fit_formula(plane({0.01}, {1.0}, {0.0}, {1e-6}))) << "nothing varies";
  EXPECT_FALSE(fit_formula(plane({0.01, 0.02}, {1.0}, {0.0}, {1e-6}))) << "two texel sizes";
  auto repeated = plane({0.01, 0.02}, {1.0}, {0.0}, {1e-6});
  repeated.insert(repeated.end(), {repeated[0], repeated[1]});
  EXPECT_FALSE(fit_formula(repeated)) << "the same two, each twice";
}

TEST(BiasFormula, Leaves_out_points_without_a_tangent_or_a_radius) {
  auto points = plane({0.01, 0.02, 0.05, 0.1}, {0.5, 1.7}, {0.0}, {1e-6});
  points.push_back({0.03, 99.0, 1e-6, {std::nan(""), 0.0, 1e-6}});
  points.push_back({0.03, 99.0, 1e-6, {1.0, std::nan(""), 1e-6}});
  const auto formula = fit_formula(points);
  ASSERT_TRUE(formula);
  EXPECT_EQ(formula->points, 8u);
  EXPECT_NEAR(term(*formula, FormulaTerm::slope).value, 0.5, 1e-9);
}

TEST(BiasFormula, Does_not_need_a_radius_where_none_is_known) {
  auto points = plane({0.01, 0.02, 0.05}, {0.5, 1.7}, {0.0}, {1e-6});
  for (FormulaPoint& point : points) point.facts.radius = std::nan("");
  const auto formula = fit_formula(points);
  ASSERT_TRUE(formula);
  EXPECT_EQ(formula->points, 6u);
  EXPECT_EQ(formula->radius.values, 0u);
  EXPECT_NEAR(term(*formula, FormulaTerm::slope).value, 0.5, 1e-9);
}

}  // namespace
}  // namespace umbrameter
