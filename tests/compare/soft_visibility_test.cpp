#include "compare/soft_visibility.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compare/sweep.h"
#include "core/random.h"
#include "row_check.h"

namespace umbrameter {
namespace {

CountedPixels all_counted(int width, int height) {
  CountedPixels counted{Image<Counting>(width, height, Counting::counted)};
  counted.mean_texel = 0.25;
  return counted;
}

TEST(SoftVisibility, The_error_is_split_by_sign) {
  // Errors −.25, +.5, 0 and one that does not count: MAE .25, of it .0833 too dark and .1667 too bright.
  Image<float> truth(4, 1, 0.5f);
  truth[2] = 1.0f;
  Image<float> raster = truth;
  raster[0] = 0.25f;
  raster[1] = 1.0f;
  raster[3] = 0.0f;
  CountedPixels counted = all_counted(4, 1);
  counted.counting[3] = Counting::turned_away;
  const Image<float> none(4, 1, 0.0f);
  const SoftVisibilityStatistics s = analyze_soft_visibility(raster, {truth, none, none, 0}, counted);
  EXPECT_EQ(s.error.pixels, 3u);
  EXPECT_DOUBLE_EQ(s.error.mae.value, 0.25);
  EXPECT_DOUBLE_EQ(s.error.too_dark.value, 0.25 / 3.0);
  EXPECT_DOUBLE_EQ(s.error.too_bright.value, 0.5 / 3.0);
  EXPECT_DOUBLE_EQ(s.error.too_bright.lower, s.error.too_bright.upper);
  EXPECT_DOUBLE_EQ(s.error.mean_error.value, 0.25 / 3.0);
  EXPECT_DOUBLE_EQ(s.penumbra, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(s.mean_texel, 0.25);
}

TEST(SoftVisibility, The_intervals_hold_the_errors_against_a_noisy_reference) {
  // Raster is off by −.2 in one half and by +.3 in the other; the noise of the truth is uniform with σ = .05, within
  // ±.0866, and so never turns a sign: the noisy MAE is without bias, .25, and .1 and .15 are its parts.
  constexpr int side = 200;
  int held = 0;
  constexpr int seeds = 200;
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    Image<float> truth(side, side);
    Image<float> raster(side, side);
    for (std::uint32_t i = 0; i < truth.size(); ++i) {
      const double noise = 0.05 * std::sqrt(12.0) * (static_cast<double>(to_unit_float(hash(i, seed))) - 0.5);
      truth[i] = static_cast<float>(0.5 + noise);
      raster[i] = i % 2 == 0 ? 0.3f : 0.8f;
    }
    const Image<float> variance(side, side, 0.0025f);
    const Image<float> samples(side, side, 1000.0f);
    const SoftVisibilityStatistics s =
        analyze_soft_visibility(raster, {truth, variance, samples, 15}, all_counted(side, side));
    held += s.error.too_dark.lower <= 0.1 && s.error.too_dark.upper >= 0.1 ? 1 : 0;
    EXPECT_NEAR(s.error.too_bright.value, 0.15, 5 * 0.05 / side);
    EXPECT_NEAR(s.error.rmse.value, std::sqrt((0.04 + 0.09) / 2.0), 1e-3);
  }
  // The interval is that of all pixels, of which only half are noise here: it holds at least 95 % less four √(.0475/n).
  EXPECT_GE(held, seeds * (0.95 - 4.0 * std::sqrt(0.0475 / seeds)));
}

TEST(SoftVisibility, Rows_stand_under_their_column) {
  SoftVisibilityStatistics s;
  s.error.pixels = 1;
  s.error.mean_truth = {2, 3, 4};
  s.penumbra = 5;
  s.error.mae = {6, 7, 8};
  s.error.rmse = {9, 10, 11};
  s.error.mean_error = {12, 13, 14};
  s.error.too_dark = {15, 16, 17};
  s.error.too_bright = {18, 19, 20};
  s.error.mean_raster = 21;
  s.error.max_error = 22;
  s.mean_texel = 23;
  test::expect_row({soft_visibility_columns(), {to_row(s)}}, {{"pixels", 1},
                                                              {"lit", 2},
                                                              {"lit_lo", 3},
                                                              {"lit_hi", 4},
                                                              {"penumbra", 5},
                                                              {"mae", 6},
                                                              {"mae_lo", 7},
                                                              {"mae_hi", 8},
                                                              {"rmse", 9},
                                                              {"rmse_lo", 10},
                                                              {"rmse_hi", 11},
                                                              {"mean_error", 12},
                                                              {"mean_error_lo", 13},
                                                              {"mean_error_hi", 14},
                                                              {"false_blocked", 15},
                                                              {"false_blocked_lo", 16},
                                                              {"false_blocked_hi", 17},
                                                              {"false_lit", 18},
                                                              {"false_lit_lo", 19},
                                                              {"false_lit_hi", 20},
                                                              {"mean_raster", 21},
                                                              {"max_error", 22},
                                                              {"mean_texel", 23}});
}

TEST(SoftVisibility, Rows_fit_their_columns_and_are_zero_without_pixels) {
  const Image<float> zero(2, 1);
  const SoftVisibilityStatistics none =
      analyze_soft_visibility(zero, {zero, zero, zero, 0}, {Image<Counting>(2, 1, Counting::background)});
  const std::vector<Value> row = to_row(none);
  ASSERT_EQ(row.size(), soft_visibility_columns().size());
  for (const Value& value : row) EXPECT_EQ(to_number(value), 0.0);
}

}  // namespace
}  // namespace umbrameter
