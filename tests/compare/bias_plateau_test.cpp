#include "compare/bias_plateau.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace umbrameter {
namespace {

BiasCell plateau_cell(double constant, double acne, double peter_panning) {
  return {constant, 0.0, acne + peter_panning, acne, 0.0, peter_panning, 0.0};
}

// Taps that flip at one bias each: acne below it, peter-panning from it on.
struct Taps {
  std::vector<double> acne;  // both ascending
  std::vector<double> panning;
  double pixels = 1.0;

  BiasCell at(double bias) const {
    const auto above = acne.end() - std::upper_bound(acne.begin(), acne.end(), bias);
    const auto below = std::upper_bound(panning.begin(), panning.end(), bias) - panning.begin();
    return plateau_cell(bias, static_cast<double>(above) / pixels, static_cast<double>(below) / pixels);
  }
  // The error changes at flips alone, so that one bias between each two neighbours, and one beyond the ends, tells all.
  double least() const {
    std::vector<double> flips = acne;
    flips.insert(flips.end(), panning.begin(), panning.end());
    std::sort(flips.begin(), flips.end());
    double least = at(flips.front() - 1.0).mae;
    for (const double flip : flips) least = std::min(least, at(flip).mae);
    return least;
  }
};

Taps random_taps(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  Taps taps;
  const int acne = 1 + static_cast<int>(uniform(0.0, 400.0));
  const int panning = 1 + static_cast<int>(uniform(0.0, 400.0));
  const double shift = uniform(-4.0, 2.0);
  for (int i = 0; i < acne; ++i) taps.acne.push_back(shift + std::exp(uniform(-4.0, 2.0)));
  for (int i = 0; i < panning; ++i) taps.panning.push_back(shift + std::exp(uniform(-3.0, 4.0)));
  std::sort(taps.acne.begin(), taps.acne.end());
  std::sort(taps.panning.begin(), taps.panning.end());
  taps.pixels = uniform(1000.0, 100'000.0);
  return taps;
}

std::vector<BiasCell> cells_of(const Taps& taps, double first, double last, int count) {
  std::vector<BiasCell> cells;
  for (int i = 0; i < count; ++i) cells.push_back(taps.at(first + (last - first) * i / (count - 1)));
  return cells;
}

TEST(BiasPlateau, Recommends_its_smallest_bias_with_little_acne) {
  // Least 0.270 % at 18; the limit is 1.05 · 0.270 = 0.2835 %. 2.2 has 0.283 % and acne of 0.1 %, the level; 2.1 has
  // 0.2834 % but acne of 0.2 %.
  const std::vector<BiasCell> cells = {plateau_cell(1.0, 0.005, 0.0),     plateau_cell(2.1, 0.002, 0.000834),
                                       plateau_cell(2.2, 0.001, 0.00183), plateau_cell(5.0, 0.0005, 0.0023),
                                       plateau_cell(18.0, 0.0, 0.0027),   plateau_cell(30.0, 0.0, 0.004)};
  const auto plateau = plateau_of(cells);
  ASSERT_TRUE(plateau);
  EXPECT_EQ(plateau->least.constant, 18.0);
  EXPECT_EQ(plateau->first.constant, 2.1);
  EXPECT_EQ(plateau->last.constant, 18.0);
  EXPECT_EQ(plateau->recommended.constant, 2.2);
  EXPECT_TRUE(plateau->has_little_acne());
  EXPECT_FALSE(plateau->open_below);
  EXPECT_FALSE(plateau->open_above);
}

TEST(BiasPlateau, Without_little_acne_on_it_recommends_the_least_error) {
  const auto plateau = plateau_of(std::vector<BiasCell>{plateau_cell(0, 0.1, 0), plateau_cell(1, 0.02, 0.001),
                                                        plateau_cell(2, 0.01, 0.01), plateau_cell(3, 0.0, 0.05)});
  EXPECT_EQ(plateau->recommended.constant, 2.0);
  EXPECT_FALSE(plateau->has_little_acne());
}

TEST(BiasPlateau, Is_connected_around_the_least_error) {
  // 1 has as little error as 3, but 2 between them has more.
  const auto plateau = plateau_of(std::vector<BiasCell>{plateau_cell(0, 0.5, 0), plateau_cell(1, 0.0, 0.0102),
                                                        plateau_cell(2, 0.0, 0.02), plateau_cell(3, 0.0, 0.01),
                                                        plateau_cell(4, 0.0, 0.0104), plateau_cell(5, 0.0, 0.5)});
  EXPECT_EQ(plateau->first.constant, 3.0);
  EXPECT_EQ(plateau->last.constant, 4.0);
}

TEST(BiasPlateau, Of_a_curve_that_reaches_0_holds_the_biases_without_error) {
  const auto plateau = plateau_of(std::vector<BiasCell>{plateau_cell(0, 0.5, 0), plateau_cell(1, 0.0, 0.0),
                                                        plateau_cell(2, 0.0, 0.0), plateau_cell(3, 0.0, 1e-6)});
  EXPECT_EQ(plateau->first.constant, 1.0);
  EXPECT_EQ(plateau->last.constant, 2.0);
  EXPECT_EQ(plateau->recommended.constant, 1.0);
}

TEST(BiasPlateau, Names_its_ends_open_where_the_biases_end) {
  const auto plateau = plateau_of(
      std::vector<BiasCell>{plateau_cell(0, 0.5, 0), plateau_cell(1, 0.0, 0.01), plateau_cell(2, 0.0, 0.01)});
  EXPECT_FALSE(plateau->open_below);
  EXPECT_TRUE(plateau->open_above);
  EXPECT_FALSE(plateau_of({}));
}

// 10,000 pixels: 3 wrong ones at 2 texels and 1 at 150. Two pixels do not decide for 150 texels.
TEST(BiasPlateau, Of_few_wrong_pixels_is_not_decided_by_one_or_two) {
  const std::vector<BiasCell> cells = {plateau_cell(1, 0.02, 0.0), plateau_cell(2, 0.0003, 0.0),
                                       plateau_cell(150, 0.0001, 0.0), plateau_cell(200, 0.0, 0.01)};
  EXPECT_EQ(plateau_of(cells)->recommended.constant, 150.0);
  const auto plateau = plateau_of(cells, {}, 10'000);
  EXPECT_EQ(plateau->recommended.constant, 2.0);
  EXPECT_EQ(plateau->last.constant, 150.0);
  EXPECT_TRUE(plateau->is_by_pixels);
  // Nor where the least error is that of more pixels: 30 and 29 are equal, 30 and 26 are not.
  const auto ramp = [](double second) {
    return std::vector<BiasCell>{plateau_cell(1, 0.0, 0.003), plateau_cell(2, 0.0, second), plateau_cell(3, 0.0, 0.5)};
  };
  EXPECT_EQ(plateau_of(ramp(0.0029), {}, 10'000)->recommended.constant, 1.0);
  EXPECT_EQ(plateau_of(ramp(0.0026), {}, 10'000)->recommended.constant, 2.0);
  // Three more are three more, though in doubles 22/N + 3/N is less than 25/N.
  const std::vector<BiasCell> three = {plateau_cell(1, 0.0, 22.0 / 35796.0), plateau_cell(2, 0.0, 25.0 / 35796.0),
                                       plateau_cell(3, 0.0, 26.0 / 35796.0)};
  EXPECT_EQ(plateau_of(three, {}, 35'796)->last.constant, 2.0);
  // Of a million pixels these are 300 against 100.
  EXPECT_EQ(plateau_of(cells, {}, 1'000'000)->recommended.constant, 150.0);
}

TEST(BiasPlateau, Costs_below_0_have_a_limit_above_the_least) {
  // −ssim: 5 % of 0.8 above −0.8.
  EXPECT_DOUBLE_EQ(plateau_limit(-0.8), -0.76);
  const std::vector<double> costs = {-0.77, std::numeric_limits<double>::quiet_NaN(), -0.77, -0.8, -0.75};
  const ConnectedRange range = connected_range(costs, 3, plateau_limit(-0.8));
  EXPECT_EQ(range.first, 2u);
  EXPECT_EQ(range.last, 3u);
}

TEST(LeastPossibleError, Is_a_bound_on_the_error_at_every_bias) {
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    const Taps taps = random_taps(seed);
    const double least = taps.least();
    for (const int count : {2, 10, 100, 10'000}) {
      const std::vector<BiasCell> cells = cells_of(taps, -6.0, 60.0, count);
      EXPECT_LE(least_possible_error(cells), least * (1.0 + 1e-12)) << seed << " " << count;
    }
    // Over cells that lie closer than the flips it is the least error.
    std::vector<BiasCell> all;
    std::vector<double> flips = taps.acne;
    flips.insert(flips.end(), taps.panning.begin(), taps.panning.end());
    std::sort(flips.begin(), flips.end());
    for (const double flip : flips) {
      all.push_back(taps.at(std::nextafter(flip, -1e9)));
      all.push_back(taps.at(flip));
    }
    EXPECT_NEAR(least_possible_error(all), least, 1e-12) << seed;
  }
}

TEST(BiasPlateau, With_the_bound_the_recommended_bias_has_at_most_5_percent_more_error_than_any) {
  int met = 0;
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    const Taps taps = random_taps(seed);
    const std::vector<BiasCell> cells = cells_of(taps, -6.0, 60.0, 20'001);
    const double possible = least_possible_error(cells);
    const auto plateau = plateau_of(cells, possible);
    ASSERT_TRUE(plateau);
    if (plateau->least.mae > plateau_limit(possible)) continue;  // these biases are too far apart for so few taps
    ++met;
    EXPECT_LE(plateau->recommended.mae, 1.05 * taps.least() * (1.0 + 1e-12)) << seed;
  }
  EXPECT_GE(met, 250);
}

TEST(LeastPossibleError, Intervals_that_may_hold_less_are_named) {
  // Between 1 and 2: A(2) + P(1) = 0.01 + 0 < 0.02. Between 0 and 1: 0.03 + 0; between 2 and 3: 0 + 0.01.
  const std::vector<BiasCell> cells = {plateau_cell(0, 0.1, 0), plateau_cell(1, 0.03, 0), plateau_cell(2, 0.01, 0.01),
                                       plateau_cell(3, 0.0, 0.05)};
  EXPECT_EQ(intervals_below(cells, 0.02), (std::vector<std::size_t>{1, 2}));
}

TEST(ReasonAgainst, A_bias_is_recommended_only_where_it_can_be_known) {
  const BiasPlateau known{plateau_cell(2, 0, 0.01), plateau_cell(1, 0, 0.01), plateau_cell(3, 0, 0.01),
                          plateau_cell(1, 0, 0.01)};
  const BiasEvidence enough{1000, 500, 500};
  EXPECT_EQ(reason_against(known, enough), std::nullopt);
  EXPECT_EQ(reason_against(known, {2, 1, 1}), NoBias::few_pixels);
  EXPECT_EQ(reason_against(known, {1000, 0, 1000}), NoBias::nothing_lit);
  EXPECT_EQ(reason_against(known, {1000, 997, 3}), NoBias::nothing_blocked);
  EXPECT_EQ(reason_against(known, {1000, 500, 500, false, false}), NoBias::no_receiver);
  EXPECT_EQ(reason_against(known, {1000, 500, 500, false, true}), std::nullopt) << "a wall receives shadows, too";
  BiasPlateau open = known;
  open.open_above = true;
  EXPECT_EQ(reason_against(open, enough), NoBias::unbounded);
  open = known;
  open.open_below = true;
  EXPECT_EQ(reason_against(open, enough), NoBias::unbounded) << "every smaller bias may be as good";
  open.recommended = known.least;
  EXPECT_EQ(reason_against(open, enough), std::nullopt) << "acne decides";
}

}  // namespace
}  // namespace umbrameter
