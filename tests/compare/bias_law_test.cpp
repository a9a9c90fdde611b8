#include "compare/bias_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace umbrameter {
namespace {

TEST(BiasFit, Finds_the_nearest_taps_of_a_plane) {
  // The least acne-free bias is ½·t·(p+q)·tan θ; θ = 60°, ψ = 0: 0.8660254 texels.
  std::vector<FitPoint> points;
  for (const double texel : {0.1, 0.05, 0.025, 0.0125}) {
    points.push_back({texel, 0.0, 0.5 * texel * std::sqrt(3.0), 0.001});
  }
  const auto law = fit_law(points);
  ASSERT_TRUE(law);
  EXPECT_EQ(law->points, 4u);
  EXPECT_NEAR(law->constant.value, 0.0, 1e-15);
  EXPECT_NEAR(law->per_texel.value, 0.8660254037844386, 1e-13);
  EXPECT_NEAR(law->residual, 0.0, 1e-15);
  EXPECT_NEAR(law->residual_texels, 0.0, 1e-13);
  ASSERT_TRUE(law->per_texel.standard_error);
  EXPECT_NEAR(*law->per_texel.standard_error, 0.0, 1e-12);
  EXPECT_FALSE(law->tangent);
  EXPECT_FALSE(law->slope_factor);
}

TEST(BiasFit, Several_slope_biases_tell_the_factor_from_the_tangent) {
  // 3×3 nearest taps, ψ = 45°, θ = 30°: c1 = 1.5·√2 = 2.1213203, tan θ = 0.5773503, and 0.004 m on top.
  const double tangent = 1.0 / std::sqrt(3.0);
  std::vector<FitPoint> points;
  for (const double texel : {0.2, 0.1, 0.05}) {
    for (const double slope : {0.0, 0.5, 1.0}) {
      points.push_back({texel, slope, 0.004 + (1.5 * std::sqrt(2.0) - slope) * texel * tangent, 0.001});
    }
  }
  const auto law = fit_law(points);
  ASSERT_TRUE(law && law->tangent && law->slope_factor);
  EXPECT_NEAR(law->constant.value, 0.004, 1e-13);
  EXPECT_NEAR(law->slope_factor->value, 2.1213203435596424, 1e-12);
  EXPECT_NEAR(law->tangent->value, 0.5773502691896258, 1e-12);
  EXPECT_NEAR(law->per_texel.value, 2.1213203435596424 * 0.5773502691896258, 1e-12);
}

TEST(BiasFit, Slope_biases_beyond_what_is_needed_leave_the_constant_alone) {
  // c0 = 2 mm, c1 = 1.2 texels, tan θ = 3: a slope-scaled bias of 1.5 or 2 is more than enough.
  std::vector<FitPoint> points;
  for (const double texel : {0.04, 0.02, 0.01}) {
    for (const double slope : {2.0, 0.5, 0.0, 1.5, 1.0}) {
      points.push_back({texel, slope, 0.002 + std::max(1.2 - slope, 0.0) * texel * 3.0, 0.001});
    }
  }
  const auto law = fit_law(points);
  ASSERT_TRUE(law && law->tangent && law->slope_factor);
  EXPECT_NEAR(law->constant.value, 0.002, 1e-14);
  EXPECT_NEAR(law->tangent->value, 3.0, 1e-11);
  EXPECT_NEAR(law->slope_factor->value, 1.2, 1e-12);
  EXPECT_EQ(law->flat_from, 1.5);
  EXPECT_NEAR(law->residual, 0.0, 1e-14);
  EXPECT_NEAR(bias_of(*law, 0.03, 0.0), 0.002 + 1.2 * 0.03 * 3.0, 1e-13);
  EXPECT_NEAR(bias_of(*law, 0.03, 1.0), 0.002 + 0.2 * 0.03 * 3.0, 1e-13);
  EXPECT_NEAR(bias_of(*law, 0.03, 1.7), 0.002, 1e-14);
}

TEST(BiasFit, Residual_and_standard_errors_are_those_of_a_straight_line) {
  // x 1 2 3 4, y 1 3 2 4: slope 0.8, intercept 0.5; misses −0.3 0.9 −0.9 0.3, their squares' sum 1.8, s² = 0.9;
  // Sxx = 5: errors √(0.9/5) = 0.4242641 and √(0.9·(1/4 + 2.5²/5)) = 1.1618950; RMS √0.45 = 0.6708204.
  // In texels: −0.3, 0.45, −0.3, 0.075: √(0.388125/4) = 0.3114984.
  const auto law = fit_law(std::vector<FitPoint>{{1, 0, 1, 7}, {2, 0, 3, 7}, {3, 0, 2, 7}, {4, 0, 4, 7}});
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->per_texel.value, 0.8, 1e-14);
  EXPECT_NEAR(law->constant.value, 0.5, 1e-14);
  EXPECT_NEAR(*law->per_texel.standard_error, 0.42426406871192851, 1e-13);
  EXPECT_NEAR(*law->constant.standard_error, 1.1618950038622251, 1e-13);
  EXPECT_NEAR(law->residual, 0.67082039324993691, 1e-13);
  EXPECT_NEAR(law->residual_texels, 0.31149839485942975, 1e-13);
}

TEST(BiasFit, A_coarse_interval_counts_less) {
  // Two exact points at b = t and one far off whose interval is 1000 times as wide: the line stays at b = t.
  const auto law = fit_law(std::vector<FitPoint>{{1, 0, 1, 0.001}, {2, 0, 2, 0.001}, {3, 0, 5, 1}});
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->per_texel.value, 1.0, 1e-4);
}

TEST(BiasFit, Two_points_are_no_law_however_often_they_are_repeated) {
  std::vector<FitPoint> points = {{0.1, 0, 0.03, 0.01}, {0.2, 0, 0.05, 0.01}};
  EXPECT_FALSE(fit_law(points));
  points.insert(points.end(), {points[0], points[1], points[0]});
  EXPECT_FALSE(fit_law(points));
  points.push_back({0.3, 0, 0.07, 0.01});
  const auto law = fit_law(points);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->per_texel.value, 0.2, 1e-13);
  EXPECT_TRUE(law->per_texel.standard_error);
}

TEST(BiasFit, One_size_of_texel_has_no_law) {
  EXPECT_FALSE(fit_law({}));
  EXPECT_FALSE(fit_law(std::vector<FitPoint>{{0.1, 0, 0.03, 0.01}}));
  EXPECT_FALSE(fit_law(std::vector<FitPoint>{{0.1, 0, 0.03, 0.01}, {0.1, 0, 0.04, 0.01}, {0.1, 0, 0.05, 0.01}}));
  EXPECT_FALSE(fit_law(std::vector<FitPoint>{{0.1, 0, 0.03, 0.01}, {0.1, 1, 0.02, 0.01}, {0.1, 2, 0.01, 0.01}}));
}

TEST(BiasFit, A_flat_surface_has_no_slope_factor) {
  // The needed bias does not fall with the slope-scaled one: tan θ = 0.
  std::vector<FitPoint> points;
  for (const double texel : {0.1, 0.2}) {
    for (const double slope : {0.0, 1.0}) points.push_back({texel, slope, 0.01, 0.001});
  }
  const auto law = fit_law(points);
  ASSERT_TRUE(law && law->tangent);
  EXPECT_NEAR(law->tangent->value, 0.0, 1e-14);
  EXPECT_FALSE(law->slope_factor);
}

TEST(BiasFit, The_ends_of_the_axis_tell_no_place) {
  const std::vector<double> axis = {0.0, 0.1, 0.3, 0.4};
  const auto at = [](double constant) { return BiasCell{constant, 2.0, 0, 0, 0, 0, 0}; };
  EXPECT_FALSE(point_of_least_error(at(0.0), 0.05, axis));
  EXPECT_FALSE(point_of_least_error(at(0.4), 0.05, axis));
  EXPECT_FALSE(point_of_least_free(at(0.0), 0.05, axis));
  const auto least = point_of_least_error(at(0.1), 0.05, axis);
  ASSERT_TRUE(least);
  EXPECT_DOUBLE_EQ(least->step, 0.15);
  EXPECT_DOUBLE_EQ(least->bias, 0.1);
  EXPECT_DOUBLE_EQ(least->slope, 2.0);
  EXPECT_DOUBLE_EQ(least->texel, 0.05);
  ASSERT_TRUE(point_of_least_free(at(0.4), 0.05, axis));
  EXPECT_DOUBLE_EQ(point_of_least_free(at(0.3), 0.05, axis)->step, 0.2);
}

}  // namespace
}  // namespace umbrameter
