#include "compare/bias_curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace umbrameter {
namespace {

BiasCell cell(double constant, double acne, double peter_panning, double slope = 0.0) {
  return {constant, slope, acne + peter_panning, acne, 0.0, peter_panning, 0.0};
}

ParetoFront front_of(const std::vector<BiasCell>& cells) {
  ParetoFront front;
  for (const BiasCell& c : cells) add(front, c);
  return front;
}

BiasLine line_of(const std::vector<BiasCell>& cells) {
  BiasLine line;
  for (const BiasCell& c : cells) add(line, c);
  return line;
}

std::vector<double> constants(const ParetoFront& front) {
  std::vector<double> values;
  for (const auto& [acne, c] : front.by_acne) values.push_back(c.constant);
  return values;
}

// Acne share of a lit plane under one nearest tap, texel t, tan θ, p ≥ q of the slope's azimuth: with s = b/(t tan θ)
// it is ½ − s/p up to (p−q)/2, ((p+q)/2 − s)²/(2pq) up to (p+q)/2, then 0. Derived from the texel's depth being that of
// its middle.
double plane_acne(double bias, double texel, double tangent, double p, double q) {
  const double s = bias / (texel * tangent);
  if (s <= (p - q) / 2.0) return 0.5 - s / p;
  if (s < (p + q) / 2.0) return std::pow((p + q) / 2.0 - s, 2.0) / (2.0 * p * q);
  return 0.0;
}

TEST(BiasLine, Acne_of_a_plane_ends_at_half_a_texel_times_the_tangent) {
  // t = 0.1 m, θ = 60°, ψ = 0: b0 = ½·t·tan 60° = 0.0866025 m; on an axis in millimetres the first without is 87 mm.
  BiasLine line;
  for (int millimetres = 200; millimetres >= 0; --millimetres) {
    const double bias = 0.001 * millimetres;
    add(line, cell(bias, plane_acne(bias, 0.1, std::sqrt(3.0), 1.0, 0.0), 0.01 * bias));
  }
  ASSERT_TRUE(line.acne_free);
  EXPECT_DOUBLE_EQ(line.acne_free->constant, 0.087);
  // ½ − s ≤ 0.001 from s = 0.499: 0.499·0.1·√3 = 0.0864293.
  EXPECT_DOUBLE_EQ(line.little_acne->constant, 0.087);
  EXPECT_DOUBLE_EQ(line.least_error->constant, 0.087);
}

TEST(BiasLine, Little_acne_comes_before_none) {
  // ψ = 45°, p = q = 1/√2: acne (p − s)² ≤ 0.001 from s = p − √0.001 = 0.675484: 0.116997 m; none from
  // b0 = ½·0.1·√2·√3 = 0.122474 m.
  const double p = std::sqrt(0.5);
  BiasLine line;
  for (int millimetres = 0; millimetres <= 200; ++millimetres) {
    const double bias = 0.001 * millimetres;
    add(line, cell(bias, plane_acne(bias, 0.1, std::sqrt(3.0), p, p), 0.0));
  }
  EXPECT_DOUBLE_EQ(line.little_acne->constant, 0.117);
  EXPECT_DOUBLE_EQ(line.acne_free->constant, 0.123);
  EXPECT_NEAR(plane_acne(0.04, 0.1, std::sqrt(3.0), p, p), 0.226735, 1e-6);
}

TEST(BiasLine, Acne_that_no_bias_cures_has_no_acne_free_bias) {
  const BiasLine line = line_of({cell(0.0, 0.3, 0.0), cell(0.1, 0.002, 0.1)});
  EXPECT_FALSE(line.acne_free);
  EXPECT_FALSE(line.little_acne);
  EXPECT_FALSE(line.best_without_acne);
  EXPECT_DOUBLE_EQ(line.least_error->constant, 0.1);
}

TEST(BiasLine, Of_equal_errors_the_least_bias_is_told_in_any_order) {
  const std::vector<BiasCell> cells = {cell(0.3, 0.0, 0.1), cell(0.1, 0.1, 0.0), cell(0.2, 0.05, 0.05)};
  EXPECT_DOUBLE_EQ(line_of(cells).least_error->constant, 0.1);
  EXPECT_DOUBLE_EQ(line_of({cells.rbegin(), cells.rend()}).least_error->constant, 0.1);
}

TEST(BiasLine, Without_cells_it_tells_nothing) {
  EXPECT_FALSE(BiasLine{}.least_error);
  EXPECT_FALSE(least_error(BiasOptima{}));
  EXPECT_FALSE(best_without_acne(BiasOptima{}));
}

TEST(BiasLine, The_best_without_acne_may_have_more_bias_than_the_least) {
  // False occlusion falls with the bias, too: 0.2 m is without acne but errs more than 0.3 m.
  BiasCell least = cell(0.2, 0.0, 0.01);
  least.false_occlusion = 0.05;
  least.mae = 0.06;
  const BiasLine line = line_of({cell(0.1, 0.04, 0.0), least, cell(0.3, 0.0, 0.05)});
  EXPECT_DOUBLE_EQ(line.acne_free->constant, 0.2);
  EXPECT_DOUBLE_EQ(line.best_without_acne->constant, 0.3);
}

TEST(BiasOptima, Its_best_cells_are_over_all_slopes) {
  BiasOptima optima;
  optima.lines = {line_of({cell(0.1, 0.1, 0.0, 2.0)}), line_of({cell(0.1, 0.05, 0.0), cell(0.2, 0.0, 0.06)})};
  optima.lines[0].slope = 2.0;
  EXPECT_DOUBLE_EQ(least_error(optima)->constant, 0.1);
  EXPECT_DOUBLE_EQ(least_error(optima)->slope, 0.0);
  EXPECT_DOUBLE_EQ(best_without_acne(optima)->constant, 0.2);
  EXPECT_DOUBLE_EQ(flattest(optima).slope, 0.0);
}

TEST(ParetoFront, Keeps_what_no_other_cell_beats) {
  // By hand: 2 is beaten by 3 (less of both), 5 by 4 (equal acne, less peter-panning).
  const std::vector<BiasCell> cells = {cell(1, 0.5, 0.0), cell(2, 0.4, 0.3), cell(3, 0.3, 0.1),
                                       cell(4, 0.1, 0.4), cell(5, 0.1, 0.6), cell(6, 0.0, 0.9)};
  const std::vector<double> expected = {6, 4, 3, 1};
  EXPECT_EQ(constants(front_of(cells)), expected);
  EXPECT_EQ(constants(front_of({cells.rbegin(), cells.rend()})), expected);
  EXPECT_FALSE(front_of(cells).thinned);
}

TEST(ParetoFront, Is_the_same_in_every_order) {
  std::vector<BiasCell> cells;
  for (int i = 0; i < 6; ++i) cells.push_back(cell(i, 0.1 * ((i * 5) % 7), 0.1 * ((i * 4) % 5), i % 2));
  const auto by_constant = [](const BiasCell& a, const BiasCell& b) { return a.constant < b.constant; };
  const std::vector<double> expected = constants(front_of(cells));
  int orders = 0;
  do {
    ASSERT_EQ(constants(front_of(cells)), expected);
    ++orders;
  } while (std::next_permutation(cells.begin(), cells.end(), by_constant));
  EXPECT_EQ(orders, 720);
}

TEST(ParetoFront, Of_equal_cells_the_least_bias_stands_for_all) {
  const ParetoFront front = front_of({cell(0.3, 0.1, 0.1, 0.0), cell(0.2, 0.1, 0.1, 3.0), cell(0.2, 0.1, 0.1, 1.0)});
  ASSERT_EQ(front.by_acne.size(), 1u);
  EXPECT_DOUBLE_EQ(front.by_acne.begin()->second.constant, 0.2);
  EXPECT_DOUBLE_EQ(front.by_acne.begin()->second.slope, 1.0);
}

TEST(ParetoFront, Without_acne_or_without_peter_panning_it_is_one_cell) {
  EXPECT_EQ(constants(front_of({cell(0.1, 0.0, 0.1), cell(0.0, 0.0, 0.0), cell(0.2, 0.0, 0.2)})),
            std::vector<double>{0.0});
  EXPECT_EQ(constants(front_of({cell(0.0, 0.4, 0.0), cell(0.1, 0.2, 0.0), cell(0.2, 0.1, 0.0)})),
            std::vector<double>{0.2});
}

TEST(ParetoFront, A_long_one_is_thinned_between_its_ends) {
  ParetoFront front;
  for (int i = 0; i <= 10'000; ++i) add(front, cell(i, 1.0 - 0.0001 * i, 0.0001 * i));
  EXPECT_TRUE(front.thinned);
  EXPECT_LE(front.by_acne.size(), ParetoFront::max_cells);
  EXPECT_GE(front.by_acne.size(), ParetoFront::max_cells / 2);
  EXPECT_DOUBLE_EQ(front.by_acne.begin()->second.constant, 10'000.0);
  EXPECT_DOUBLE_EQ(front.by_acne.rbegin()->second.constant, 0.0);
}

TEST(Knee, Is_farthest_below_the_chord) {
  // Scaled to the ends (0.4, 0) and (0, 0.02): sums 0.25 + 0.5 = 0.75, 0.5 + 0.05 = 0.55, 0.75 + 0.025 = 0.775.
  const auto found = knee(
      front_of({cell(1, 0.4, 0.0), cell(2, 0.3, 0.0005), cell(3, 0.2, 0.001), cell(4, 0.1, 0.01), cell(5, 0.0, 0.02)}));
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->constant, 3.0);
}

TEST(Knee, Does_not_depend_on_the_scale_of_either_axis) {
  // y = 1/x over [1, 4], scaled: the tangent is parallel to the chord at x = 2.
  for (const double scale : {1.0, 1e-5}) {
    ParetoFront front;
    for (int i = 0; i <= 300; ++i) add(front, cell(i, 1.0 + 0.01 * i, scale / (1.0 + 0.01 * i)));
    ASSERT_TRUE(knee(front));
    EXPECT_NEAR(knee(front)->acne, 2.0, 1e-9) << scale;
  }
}

TEST(Knee, A_straight_front_of_tenths_has_none) {
  // 0.1, 0.2 and 0.3 are no binary fractions: their sums miss 1 by an ulp.
  for (const double first : {0.0, 0.1, 0.7}) {
    for (const double scale : {1.0, 0.001}) {
      ParetoFront front;
      for (int i = 0; i <= 10; ++i) add(front, cell(i, first + scale * (0.1 * i), first + scale * (0.1 * (10 - i))));
      ASSERT_EQ(front.by_acne.size(), 11u);
      EXPECT_FALSE(knee(front)) << first << " " << scale;
    }
  }
  EXPECT_TRUE(knee(front_of({cell(0, 0.0, 1.0), cell(1, 0.5 - 1e-12, 0.5), cell(2, 1.0, 0.0)})));
}

TEST(Knee, A_front_that_does_not_bend_towards_the_origin_has_none) {
  EXPECT_FALSE(knee(ParetoFront{}));
  EXPECT_FALSE(knee(front_of({cell(1, 0.2, 0.1)})));
  EXPECT_FALSE(knee(front_of({cell(1, 0.2, 0.1), cell(2, 0.1, 0.2)})));
  EXPECT_FALSE(knee(front_of({cell(1, 0.5, 0.0), cell(2, 0.25, 0.5), cell(3, 0.0, 1.0)})));
  EXPECT_FALSE(knee(front_of({cell(1, 1.0, 0.0), cell(2, 0.75, 0.75), cell(3, 0.0, 1.0)})));
}

}  // namespace
}  // namespace umbrameter
