#include "compare/soft_visibility.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compare/sweep.h"
#include "core/random.h"

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
  const SoftVisibilityStatistics s = analyze_soft_visibility(raster, truth, Image<float>(4, 1, 0.0f), counted);
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
    const SoftVisibilityStatistics s =
        analyze_soft_visibility(raster, truth, Image<float>(side, side, 0.05f), all_counted(side, side));
    held += s.error.too_dark.lower <= 0.1 && s.error.too_dark.upper >= 0.1 ? 1 : 0;
    EXPECT_NEAR(s.error.too_bright.value, 0.15, 5 * 0.05 / side);
    EXPECT_NEAR(s.error.rmse.value, std::sqrt((0.04 + 0.09) / 2.0), 1e-3);
  }
  // The interval is that of all pixels, of which only half are noise here: it holds at least 95 % less four √(.0475/n).
  EXPECT_GE(held, seeds * (0.95 - 4.0 * std::sqrt(0.0475 / seeds)));
}

TEST(SoftVisibility, Rows_fit_their_columns_and_are_zero_without_pixels) {
  const SoftVisibilityStatistics none = analyze_soft_visibility(
      Image<float>(2, 1), Image<float>(2, 1), Image<float>(2, 1), {Image<Counting>(2, 1, Counting::background)});
  const std::vector<Value> row = to_row(none);
  ASSERT_EQ(row.size(), soft_visibility_columns().size());
  for (const Value& value : row) EXPECT_EQ(to_number(value), 0.0);
}

}  // namespace
}  // namespace umbrameter
