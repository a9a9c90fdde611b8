#include "compare/soft_visibility.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compare/error_sums.h"
#include "core/random.h"
#include "experiments/settings/sweep.h"
#include "row_check.h"

namespace umbrameter {
namespace {

CountedPixels all_counted(int width, int height) {
  CountedPixels counted{Image<PixelExclusion>(width, height, PixelExclusion::none)};
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
  counted.exclusion[3] = PixelExclusion::back_facing;
  const Image<float> none(4, 1, 0.0f);
  const SoftVisibilityStatistics s = analyze_soft_visibility(raster, {truth, none, none, 0}, counted);
  EXPECT_EQ(s.error.pixels, 3u);
  EXPECT_DOUBLE_EQ(s.error.mae.value, 0.25);
  EXPECT_DOUBLE_EQ(s.error.too_dark.value, 0.25 / 3.0);
  EXPECT_DOUBLE_EQ(s.error.too_bright.value, 0.5 / 3.0);
  EXPECT_DOUBLE_EQ(s.error.too_bright.lower, s.error.too_bright.upper);
  EXPECT_DOUBLE_EQ(s.error.mean_error.value, 0.25 / 3.0);
  // 4V(1 − V) is 1 at ½ and 0 at 1: weights 1, 1 and 0, and of their errors (.25 + .5) / 2.
  EXPECT_DOUBLE_EQ(s.penumbra.value, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(s.penumbra_mae.value, 0.375);
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

// Box and Muller 1958.
double gaussian(std::uint32_t pixel, std::uint32_t seed, std::uint32_t part) {
  const double u = (hash(pixel, seed, 2 * part) + 0.5) * 0x1p-32;
  const double v = (hash(pixel, seed, 2 * part + 1) + 0.5) * 0x1p-32;
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * pi * v);
}

constexpr int noisy_side = 60;
constexpr double noise = 0.05;

// A reference of 8 independent values a pixel around `true_error`(pixel) below a raster of 0.5.
template <class TrueError>
SoftVisibilityStatistics measure_noisy(std::uint32_t seed, const TrueError& true_error) {
  constexpr std::uint32_t values = 8;
  Image<float> truth(noisy_side, noisy_side);
  Image<float> variance(noisy_side, noisy_side);
  for (std::uint32_t i = 0; i < truth.size(); ++i) {
    double sum = 0.0;
    double squares = 0.0;
    for (std::uint32_t k = 0; k < values; ++k) {
      const double value = noise * std::sqrt(double{values}) * gaussian(i, seed, k);
      sum += value;
      squares += value * value;
    }
    truth[i] = static_cast<float>(0.5 - true_error(i) + sum / values);
    variance[i] = static_cast<float>((squares - sum * sum / values) / (values - 1) / values);
  }
  const Image<float> samples(noisy_side, noisy_side, 1e6f);
  return analyze_soft_visibility(Image<float>(noisy_side, noisy_side, 0.5f),
                                 {truth, variance, samples, static_cast<int>(values) - 1},
                                 all_counted(noisy_side, noisy_side));
}

bool holds(const Estimate& estimate, double answer) { return estimate.lower <= answer && answer <= estimate.upper; }

TEST(SoftVisibility, The_interval_of_a_part_holds_it_95_times_in_100_and_takes_the_noise_of_that_part_alone) {
  // One pixel in ten is too dark by four standard errors, the others too bright by six.
  const auto true_error = [](std::uint32_t i) { return (i % 10 == 0 ? -4.0 : 6.0) * noise; };
  constexpr int seeds = 1000;
  int dark = 0;
  int bright = 0;
  double width = 0.0;
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    const SampledError error = measure_noisy(seed, true_error).error;
    dark += holds(error.too_dark, 0.1 * 4.0 * noise) ? 1 : 0;
    bright += holds(error.too_bright, 0.9 * 6.0 * noise) ? 1 : 0;
    width += (error.too_dark.upper - error.too_dark.value) / seeds;
  }
  EXPECT_GE(dark, 0.94 * seeds);
  EXPECT_LE(dark, 0.97 * seeds);
  EXPECT_GE(bright, 0.94 * seeds);
  EXPECT_LE(bright, 0.97 * seeds);
  // The mean of n pixels, of which a tenth have the noise of a part: 1.96 σ √(n/10) / n.
  EXPECT_NEAR(width, 1.959964 * noise * std::sqrt(0.1) / noisy_side, 0.01 * width);
}

TEST(SoftVisibility, The_lower_end_of_a_part_allows_for_what_noise_adds_and_for_about_twice_that) {
  // True errors equally likely anywhere up to `reach` standard errors on either side of zero: the part is their mean
  // below zero, a quarter of the reach. Where the raster is right, noise adds σ/√(2π) to each part.
  for (const double reach : {0.0, 0.5, 1.0, 3.0, 20.0}) {
    constexpr double pixels = double{noisy_side} * noisy_side;
    const auto true_error = [&](std::uint32_t i) { return reach * noise * (2.0 * (i + 0.5) / pixels - 1.0); };
    const double answer = 0.25 * reach * noise;
    constexpr int seeds = 100;
    int held = 0;
    double below = 0.0;
    double added = 0.0;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
      const Estimate part = measure_noisy(seed, true_error).error.too_dark;
      held += holds(part, answer) ? 1 : 0;
      below += (part.value - part.lower) / seeds;
      added += (part.value - answer) / seeds;
    }
    EXPECT_GE(held, 0.95 * seeds) << reach;
    // The bound is twice the density of errors at zero, by a kernel √(1 + ¼) times as high, and 1/28 for the estimated
    // standard errors: 2.32. The noise of the part's mean, with a slope of at most 1.5 on average, comes on top.
    EXPECT_LE(below, 2.4 * added + 1.5 * 1.96 * noise / noisy_side) << reach;
    if (reach == 0.0) {
      EXPECT_NEAR(added, noise / std::sqrt(2.0 * pi), 0.01 * noise);
    }
  }
}

TEST(SoftVisibility, The_interval_of_the_rms_error_holds_it_95_times_in_100_for_errors_below_the_noise_and_above) {
  for (const double reach : {0.5, 3.0}) {
    constexpr std::uint32_t pixels = noisy_side * noisy_side;
    const auto true_error = [&](std::uint32_t i) { return reach * noise * (2.0 * (i + 0.5) / pixels - 1.0); };
    double squares = 0.0;
    for (std::uint32_t i = 0; i < pixels; ++i) squares += true_error(i) * true_error(i) / pixels;
    constexpr int seeds = 300;
    int held = 0;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
      held += holds(measure_noisy(seed, true_error).error.rmse, std::sqrt(squares)) ? 1 : 0;
    }
    EXPECT_GE(held, 0.92 * seeds) << reach;
    EXPECT_LE(held, 0.98 * seeds) << reach;
  }
}

// A penumbra that fades from lit to blocked over the width of the image, seen by N random rays in groups of equal size,
// and one tap that is right to within them.
struct Ramp {
  static constexpr int width = 100;
  static constexpr int height = 20;
  static double visibility(int x) { return std::pow((x + 0.5) / width, 3.0); }  // mostly faint

  static SoftVisibilityStatistics measure(std::uint32_t seed, int rays) {
    constexpr int groups = 8;
    Image<float> truth(width, height);
    Image<float> variance(width, height);
    Image<float> raster(width, height);
    std::uint32_t ray = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        double sum = 0.0;
        double squares = 0.0;
        for (int g = 0; g < groups; ++g) {
          double lit = 0.0;
          for (int r = 0; r < rays / groups; ++r) lit += to_unit_float(hash(ray++, seed)) < visibility(x) ? 1.0 : 0.0;
          const double mean = lit * groups / rays;
          sum += mean;
          squares += mean * mean;
        }
        truth.at(x, y) = static_cast<float>(sum / groups);
        variance.at(x, y) = static_cast<float>((squares - sum * sum / groups) / (groups - 1) / groups);
        raster.at(x, y) = visibility(x) < 0.5 ? 0.0f : 1.0f;
      }
    }
    const Image<float> samples(width, height, static_cast<float>(rays));
    return analyze_soft_visibility(raster, {truth, variance, samples, groups - 1}, all_counted(width, height));
  }
};

TEST(SoftVisibility, The_penumbra_and_its_error_do_not_depend_on_the_number_of_rays_and_their_intervals_hold_them) {
  double weight = 0.0;
  double error = 0.0;
  for (int x = 0; x < Ramp::width; ++x) {
    const double v = Ramp::visibility(x);
    weight += 4.0 * v * (1.0 - v);
    error += 4.0 * v * (1.0 - v) * std::min(v, 1.0 - v);
  }
  for (const int rays : {64, 256}) {
    constexpr int seeds = 200;
    int held = 0;
    int error_held = 0;
    double mean = 0.0;
    double mean_error = 0.0;
    double squares = 0.0;
    double error_squares = 0.0;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
      const SoftVisibilityStatistics s = Ramp::measure(seed, rays);
      held += holds(s.penumbra, weight / Ramp::width) ? 1 : 0;
      error_held += holds(s.penumbra_mae, error / weight) ? 1 : 0;
      mean += s.penumbra.value / seeds;
      mean_error += s.penumbra_mae.value / seeds;
      squares += std::pow(s.penumbra.value - weight / Ramp::width, 2) / seeds;
      error_squares += std::pow(s.penumbra_mae.value - error / weight, 2) / seeds;
    }
    // 200 draws of 0.95 deviate by at most three times 1.5 %; means by four standard errors of theirs.
    EXPECT_NEAR(held, 0.95 * seeds, 0.045 * seeds) << rays;
    EXPECT_NEAR(error_held, 0.95 * seeds, 0.045 * seeds) << rays;
    EXPECT_NEAR(mean, weight / Ramp::width, 4.0 * std::sqrt(squares / seeds)) << rays;
    EXPECT_NEAR(mean_error, error / weight, 4.0 * std::sqrt(error_squares / seeds)) << rays;
  }
}

TEST(SoftVisibility, Noise_adds_nothing_to_the_error_of_a_technique_that_shows_all_or_nothing) {
  double answer = 0.0;
  for (int x = 0; x < Ramp::width; ++x) {
    answer += std::min(Ramp::visibility(x), 1.0 - Ramp::visibility(x)) / Ramp::width;
  }
  constexpr int seeds = 200;
  int held = 0;
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    const SoftVisibilityStatistics s = Ramp::measure(seed, 64);
    held += holds(s.error.mae, answer) ? 1 : 0;
    for (const Estimate& part : {s.error.mae, s.error.too_dark, s.error.too_bright}) {
      EXPECT_NEAR(part.value - part.lower, part.upper - part.value, 1e-9);
    }
    EXPECT_EQ(s.error.mae_noise, 0.0);
    EXPECT_EQ(s.penumbra_noise, 0.0);
  }
  EXPECT_NEAR(held, 0.95 * seeds, 0.045 * seeds);
}

TEST(SoftVisibility, Noise_adds_at_most_twice_the_distance_from_all_or_nothing) {
  // E |x − k/n| of k hits of n rays, from the binomial distribution, less |x − v|.
  for (const int rays : {1, 2, 5, 16}) {
    for (int i = 0; i <= 40; ++i) {
      const double v = i / 40.0;
      for (int j = 0; j <= 40; ++j) {
        const double x = j / 40.0;
        double mean = 0.0;
        double combinations = 1.0;
        for (int k = 0; k <= rays; ++k) {
          mean += combinations * std::pow(v, k) * std::pow(1.0 - v, rays - k) * std::abs(x - double(k) / rays);
          combinations *= double(rays - k) / (k + 1);
        }
        EXPECT_LE(mean - std::abs(x - v), most_excess(x) + 1e-12) << rays << " rays, " << v << ", " << x;
      }
    }
  }
}

TEST(SoftVisibility, Rows_stand_under_their_column) {
  SoftVisibilityStatistics s;
  s.error.pixels = 1;
  s.error.mean_truth = {2, 3, 4};
  s.penumbra = {5, 5.25, 5.5};
  s.error.mae = {6, 7, 8};
  s.error.rmse = {9, 10, 11};
  s.error.mean_error = {12, 13, 14};
  s.error.too_dark = {15, 16, 17};
  s.error.too_bright = {18, 19, 20};
  s.error.mean_raster = 21;
  s.error.max_error = 22;
  s.mean_texel = 23;
  s.penumbra_mae = {24, 25, 26};
  test::expect_row({columns_of(SoftVisibilityStatistics{}), {row_of(s)}}, {{"pixels", 1},
                                                                           {"lit", 2},
                                                                           {"lit_lo", 3},
                                                                           {"lit_hi", 4},
                                                                           {"penumbra", 5},
                                                                           {"penumbra_lo", 5.25},
                                                                           {"penumbra_hi", 5.5},
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
                                                                           {"mean_texel", 23},
                                                                           {"penumbra_mae", 24},
                                                                           {"penumbra_mae_lo", 25},
                                                                           {"penumbra_mae_hi", 26}});
}

TEST(SoftVisibility, Rows_fit_their_columns_and_hold_no_numbers_without_pixels) {
  const Image<float> zero(2, 1);
  const SoftVisibilityStatistics none =
      analyze_soft_visibility(zero, {zero, zero, zero, 0}, {Image<PixelExclusion>(2, 1, PixelExclusion::background)});
  const std::vector<Value> row = row_of(none);
  ASSERT_EQ(row.size(), columns_of(SoftVisibilityStatistics{}).size());
  EXPECT_EQ(to_number(row[0]), 0.0);
  for (std::size_t i = 1; i < row.size(); ++i) EXPECT_TRUE(std::isnan(to_number(row[i]))) << i;
}

}  // namespace
}  // namespace umbrameter
