#include "core/jackknife.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "core/quantiles.h"
#include "core/random.h"

namespace umbrameter {
namespace {

constexpr int side = 8;

// How often the 95 % interval of the mean of 8 × 8 blocks holds 0, of 100 draws in 1. A block's value is its own noise
// and `share` of that of each of its four neighbours.
double coverage(double share, bool with_places) {
  constexpr std::uint32_t draws = 2000;
  int held = 0;
  for (std::uint32_t draw = 0; draw < draws; ++draw) {
    std::array<std::array<double, side + 2>, side + 2> noise{};
    for (std::uint32_t i = 0; i < noise.size() * noise.size(); ++i) {
      double& each = noise[i / noise.size()][i % noise.size()];
      for (std::uint32_t k = 0; k < 4; ++k) each += to_unit_float(hash(draw, i, k)) - 0.5;
    }
    std::vector<double> values;
    std::vector<BlockPlace> places;
    double sum = 0.0;
    for (std::size_t y = 1; y <= side; ++y) {
      for (std::size_t x = 1; x <= side; ++x) {
        values.push_back(noise[y][x] + share * (noise[y - 1][x] + noise[y + 1][x] + noise[y][x - 1] + noise[y][x + 1]));
        places.push_back({static_cast<int>(x), static_cast<int>(y)});
        sum += values.back();
      }
    }
    std::vector<double> without;
    for (const double each : values) without.push_back((sum - each) / (side * side - 1));
    if (!with_places) places.clear();
    const JackknifeVariance of = jackknife_variance(without, places);
    held += std::abs(sum / (side * side)) <= student_95(of.degrees_of_freedom) * std::sqrt(of.variance) ? 1 : 0;
  }
  return static_cast<double>(held) / draws;
}

TEST(Jackknife, Of_independent_blocks_holds_the_mean_in_95_of_100_cases_with_and_without_their_places) {
  EXPECT_NEAR(coverage(0.0, false), 0.95, 0.015);
  EXPECT_NEAR(coverage(0.0, true), 0.95, 0.015);
}

// Of neighbours with a correlation of 0.1 the mean has 1.43 times the variance of independent blocks:
// (1 + 4s)² / (1 + 4s²) for s = 0.05.
TEST(Jackknife, Of_blocks_that_are_like_their_neighbours_needs_their_places) {
  EXPECT_LT(coverage(0.05, false), 0.92);
  EXPECT_NEAR(coverage(0.05, true), 0.95, 0.03);
}

TEST(Jackknife, Of_blocks_that_are_all_neighbours_is_that_of_independent_ones) {
  const std::vector<double> without = {1.0, 2.0, 4.0, 5.0};
  const std::vector<BlockPlace> places = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  // ¾ (4 + 1 + 1 + 4)
  EXPECT_DOUBLE_EQ(jackknife_variance(without, places).variance, 7.5);
  EXPECT_DOUBLE_EQ(jackknife_variance(without).variance, 7.5);
}

}  // namespace
}  // namespace umbrameter
