#include "compare/ao.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "experiments/settings/sweep.h"
#include "row_check.h"

namespace umbrameter {
namespace {

GBuffer all_surface(int width, int height) {
  GBuffer gbuffer(width, height);
  for (auto& instance : gbuffer.instance.pixels) instance = 0;
  return gbuffer;
}

// Box and Muller 1958.
double gaussian(std::uint32_t pixel, std::uint32_t seed) {
  const double u = (hash(pixel, seed, 0u) + 0.5) * 0x1p-32;
  const double v = (hash(pixel, seed, 1u) + 0.5) * 0x1p-32;
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * pi * v);
}

// Of this accessibility in 400 pixels, against 0.6 with Gaussian noise of σ = 0.05.
SampledError error_against_noise(float raster, std::uint32_t seed) {
  Image<float> truth(20, 20);
  for (std::uint32_t i = 0; i < truth.size(); ++i) truth[i] = static_cast<float>(0.6 + 0.05 * gaussian(i, seed));
  const Image<float> variance(20, 20, 0.0025f);
  const Image<float> samples(20, 20, 64.0f);
  return analyze_ao(Image<float>(20, 20, raster), {truth, variance, samples, 7}, all_surface(20, 20)).error;
}

TEST(Ao, An_exact_reference_leaves_no_interval) {
  const Image<float> truth(2, 1, 0.5f);
  Image<float> raster(2, 1, 0.25f);
  raster[1] = 1.0f;
  const Image<float> none(2, 1, 0.0f);
  const SampledError s = analyze_ao(raster, {truth, none, none, 0}, all_surface(2, 1)).error;
  EXPECT_EQ(s.pixels, 2u);
  EXPECT_DOUBLE_EQ(s.mae.value, 0.375);
  EXPECT_DOUBLE_EQ(s.mae.lower, 0.375);
  EXPECT_DOUBLE_EQ(s.mae.upper, 0.375);
  EXPECT_DOUBLE_EQ(s.mean_error.value, 0.125);
  EXPECT_DOUBLE_EQ(s.rmse.value, std::sqrt((0.0625 + 0.25) / 2.0));
  EXPECT_EQ(s.max_x, 1);
}

TEST(Ao, Background_does_not_count) {
  GBuffer gbuffer = all_surface(2, 1);
  gbuffer.instance[1] = no_id;
  Image<float> raster(2, 1, 0.5f);
  raster[1] = 0.0f;
  const Image<float> truth(2, 1, 0.5f);
  const Image<float> exact(2, 1, 0.0f);
  const SampledError s = analyze_ao(raster, {truth, exact, exact, 0}, gbuffer).error;
  EXPECT_EQ(s.pixels, 1u);
  EXPECT_EQ(s.mae.value, 0.0);
  const SampledError none = analyze_ao(raster, {raster, exact, exact, 0}, GBuffer(2, 1)).error;
  const std::vector<Value> row = row_of(AoStatistics{none});
  EXPECT_EQ(to_number(row[0]), 0.0);
  for (std::size_t i = 1; i < row.size(); ++i) EXPECT_TRUE(std::isnan(to_number(row[i]))) << i;
}

TEST(Ao, The_noise_of_the_reference_is_not_reported_as_rms_error) {
  // raster is exact, the truth has Gaussian noise of σ = 0.1: uncorrected RMSE would be 0.1.
  Image<float> truth(400, 400);
  for (std::uint32_t i = 0; i < truth.size(); ++i) truth[i] = static_cast<float>(0.5 + 0.1 * gaussian(i, 5));
  const Image<float> variance(400, 400, 0.01f);
  const Image<float> samples(400, 400, 64.0f);
  const SampledError s =
      analyze_ao(Image<float>(400, 400, 0.5f), {truth, variance, samples, 7}, all_surface(400, 400)).error;
  // The mean square has a standard deviation of √2 · 0.01 / 400 = 3.5e-5; five of them bound the RMSE by 0.0134.
  EXPECT_LT(s.rmse.value, 0.0134);
  EXPECT_EQ(s.rmse.lower, 0.0);
  EXPECT_LT(s.mae.lower, 0.02) << "the noise alone makes a mean absolute error of 0.08; the bound must heed it";
}

TEST(Ao, The_interval_holds_the_true_mean_error_95_times_in_100) {
  constexpr int trials = 400;
  int held = 0;
  for (std::uint32_t seed = 0; seed < trials; ++seed) {
    const SampledError s = error_against_noise(0.7f, seed);
    held += s.mean_error.lower <= 0.1 && 0.1 <= s.mean_error.upper ? 1 : 0;
  }
  // Binomial(400, 0.95): 380 ± 4 · 4.36.
  EXPECT_NEAR(held, 380, 17.5);
}

TEST(Ao, The_mean_absolute_error_is_at_least_as_large_as_the_mean_error) {
  // Every pixel is 0.05 too bright, and the noise is as large. What it adds to |error| is 0.0083.
  constexpr int trials = 400;
  int held = 0;
  int part_held = 0;
  for (std::uint32_t seed = 0; seed < trials; ++seed) {
    const SampledError s = error_against_noise(0.65f, seed);
    EXPECT_GE(s.mae.lower, s.mean_error.lower);
    EXPECT_GE(s.too_bright.lower, s.mean_error.lower);
    EXPECT_EQ(s.too_dark.lower, 0.0);
    held += s.mae.lower <= 0.05 && 0.05 <= s.mae.upper ? 1 : 0;
    part_held += s.too_bright.lower <= 0.05 && 0.05 <= s.too_bright.upper ? 1 : 0;
  }
  // The lower end alone can fail, in 2.5 % of the trials: 10 ± 4 · 3.1.
  EXPECT_GE(held, trials - 23);
  EXPECT_GE(part_held, trials - 23);
}

TEST(Ao, The_interval_of_one_pixel_s_mean_is_student_s_and_that_of_many_normal) {
  // 2.364624 with 7 degrees of freedom; 6400 pixels of one variance have 44800, where the normal 1.959964 is right.
  for (const int side : {1, 80}) {
    const Image<float> ao(side, side, 0.5f);
    const Image<float> variance(side, side, 0.01f);
    const Image<float> samples(side, side, 1e6f);
    const SampledError s = analyze_ao(ao, {ao, variance, samples, 7}, all_surface(side, side)).error;
    EXPECT_NEAR(s.mean_truth.upper - 0.5, (side == 1 ? 2.364624 : 1.959964) * 0.1 / side, 1e-5 / side);
  }
}

TEST(Ao, Rays_that_all_agree_still_leave_an_interval) {
  // 100 pixels of 64 rays, all open: 6400 rays miss a share of 3/6400 with a probability of 5 %.
  const Image<float> open(10, 10, 1.0f);
  const SampledError s =
      analyze_ao(open, {open, Image<float>(10, 10, 0.0f), Image<float>(10, 10, 64.0f), 7}, all_surface(10, 10)).error;
  EXPECT_NEAR(s.mean_truth.lower, 1.0 - 2.99573 / 6400.0, 1e-8);
  const Image<float> closed(10, 10, 0.0f);
  const SampledError dark =
      analyze_ao(closed, {closed, closed, Image<float>(10, 10, 64.0f), 7}, all_surface(10, 10)).error;
  EXPECT_EQ(dark.mean_truth.lower, 0.0) << "no accessibility is negative";
  EXPECT_NEAR(dark.mean_truth.upper, 2.99573 / 6400.0, 1e-8);
}

TEST(Ao, Rows_stand_under_their_column) {
  SampledError s;
  s.pixels = 1;
  s.mae = {2, 3, 4};
  s.rmse = {5, 6, 7};
  s.mean_error = {8, 9, 10};
  s.mean_raster = 11;
  s.mean_truth = {12, 13, 14};
  s.max_error = 15;
  test::expect_row({columns_of(AoStatistics{}), {row_of(AoStatistics{s})}}, {{"pixels", 1},
                                                                             {"mae", 2},
                                                                             {"mae_lo", 3},
                                                                             {"mae_hi", 4},
                                                                             {"rmse", 5},
                                                                             {"rmse_lo", 6},
                                                                             {"rmse_hi", 7},
                                                                             {"mean_error", 8},
                                                                             {"mean_error_lo", 9},
                                                                             {"mean_error_hi", 10},
                                                                             {"mean_raster", 11},
                                                                             {"mean_truth", 12},
                                                                             {"mean_truth_lo", 13},
                                                                             {"mean_truth_hi", 14},
                                                                             {"max_error", 15}});
}

TEST(Ao, Every_column_has_a_unit) {
  for (const Column& column : columns_of(AoStatistics{})) EXPECT_FALSE(column.unit.empty()) << column.name;
}

}  // namespace
}  // namespace umbrameter
