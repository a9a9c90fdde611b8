// Moment shadow maps: against the exact share of lit texels, and against a solution in extended precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "tests/techniques/prefiltered_depths.h"

namespace umbrameter {
namespace {

using namespace test;

ShadowParams hamburger() { return with(ShadowTechniques::choice<Msm>); }

ShadowParams hausdorff() {
  ShadowParams params = hamburger();
  params.msm.bound = MomentBound::hausdorff;
  return params;
}

// Means of the powers of the depths, which no format has rounded.
dvec4 exact_moments(const Depths& depths) {
  dvec4 sum(0.0);
  for (const float each : depths) {
    const auto z = static_cast<double>(each);
    sum += dvec4(z, z * z, z * z * z, z * z * z * z);
  }
  return sum / static_cast<double>(depths.size());
}

TEST(Prefiltered, The_hausdorff_bound_lies_between_the_share_of_lit_texels_and_the_hamburger_bound) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> uniform;
  std::size_t sharper = 0;
  for (int round = 0; round < 20000; ++round) {
    Depths surfaces(2 + random() % 6);
    for (float& z : surfaces) z = uniform(random);
    // Often at the ends of the range, where the bound is sharper.
    if (round % 2 == 0) surfaces[0] = static_cast<float>(round / 2 % 2);
    Depths depths(25);
    for (float& z : depths) z = surfaces[random() % surfaces.size()];
    const float depth = round % 3 == 0 ? surfaces[1] : uniform(random);
    const dvec4 moments = exact_moments(depths);
    const float found = text_of(hausdorff()).visibility(moments, static_cast<double>(depth));
    const float looser = text_of(hamburger()).visibility(moments, static_cast<double>(depth));
    constexpr double rounding = 1e-6;  // of the results to floats, and of the solution
    EXPECT_GE(found, exact(depths, depth) - 1e-5 - rounding) << round << ": MSM's bias takes at most 1e-5";
    EXPECT_LE(found, static_cast<double>(looser) + rounding) << round;
    if (found < looser - 0.05f) ++sharper;
  }
  EXPECT_GT(sharper, 1000u);
}

// The largest share of a distribution with these means of powers that can lie in front of `depth`, from polynomials:
// the weights of three depths follow from Lagrange's polynomials, whose means are the weights, and the other two depths
// are those for which the means of (z − d)·p(z), p their polynomial, and of its product with z are 0.
long double lit_bound(const dvec4& stored, long double depth, long double bias) {
  std::array<long double, 5> b{1.0L};
  for (int i = 0; i < 4; ++i) {
    const auto moment = static_cast<long double>(stored[i]);
    b[static_cast<std::size_t>(i) + 1] = moment + bias * (0.5L - moment);
  }
  // With m_k the mean of zᵏ·(z − d): m_2 + s·m_1 + t·m_0 = 0 and m_3 + s·m_2 + t·m_1 = 0 for p = z² + s·z + t.
  const auto m = [&](std::size_t k) { return b[k + 1] - depth * b[k]; };
  const long double determinant = m(1) * m(1) - m(0) * m(2);
  const long double s = (m(0) * m(3) - m(2) * m(1)) / determinant;
  const long double t = (m(2) * m(2) - m(1) * m(3)) / determinant;
  const long double root = std::sqrt(s * s / 4 - t);
  const long double near = -s / 2 - root;
  const long double far = -s / 2 + root;
  const auto weight = [&](long double at, long double one, long double other) {
    return (b[2] - (one + other) * b[1] + one * other) / ((at - one) * (at - other));
  };
  if (depth <= near) return 1.0L;
  return depth <= far ? 1.0L - weight(near, depth, far) : weight(depth, near, far);
}

TEST(Prefiltered, Msm_solves_the_stored_moments_as_extended_precision_does) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform;
  std::size_t checked = 0;
  for (int round = 0; round < 20000; ++round) {
    // A kernel that covers a sloped plane, and in every other round a second one in front of part of it.
    const float z = 0.1f + 0.8f * uniform(random);
    const float slope = 0.004f * uniform(random);
    Depths depths(25);
    for (std::size_t i = 0; i < depths.size(); ++i) depths[i] = z + slope * (static_cast<float>(i % 5) - 2.0f);
    if (round % 2 == 0) std::fill_n(depths.begin(), random() % 25, 0.9f * z);
    const float depth = z + 0.02f * (uniform(random) - 0.5f);
    const PrefilteredText text = text_of(hamburger());
    const dvec4 stored(mean_of(depths, text));
    // The bias as the shader reads it.
    const long double bound = lit_bound(stored, depth, static_cast<float>(MsmParams{}.moment_bias));
    // NaN where rounding of the stored moments has left none that a distribution has.
    if (!(bound >= 0.0L && bound <= 1.0L)) continue;
    ++checked;
    EXPECT_NEAR(text.visibility(stored, static_cast<double>(depth)), static_cast<double>(bound), 1e-6) << round;
  }
  EXPECT_GT(checked, 19000u);
}

TEST(Prefiltered, The_hausdorff_bound_is_exact_for_both_ends_and_two_depths_at_either_of_them) {
  const Depths depths{0.0f, 0.0f, 0.3f, 0.3f, 0.3f, 0.6f, 0.6f, 1.0f, 1.0f, 1.0f};
  for (const float depth : {0.3f, 0.6f}) {
    EXPECT_NEAR(visibility(depths, depth, hausdorff()), exact(depths, depth), 1e-3) << depth;
    EXPECT_GT(visibility(depths, depth, hamburger()), exact(depths, depth) + 0.01) << depth;
  }
}

TEST(Prefiltered, Msm_is_exact_for_two_depths_and_vsm_is_so_only_at_the_far_one) {
  for (const int near : {1, 3, 6, 9}) {
    Depths depths(10, 0.7f);
    std::fill_n(depths.begin(), near, 0.2f);
    for (const float depth : {0.1f, 0.3f, 0.5f, 0.65f, 0.75f, 0.9f}) {
      EXPECT_NEAR(visibility(depths, depth, hamburger()), exact(depths, depth), 1e-3) << near << depth;
    }
    // σ²/(σ² + (d − μ)²) is the share of the far depth there.
    EXPECT_NEAR(visibility(depths, 0.7f, with(ShadowTechniques::choice<Vsm>)), exact(depths, 0.7f), 1e-4) << near;
    EXPECT_GT(visibility(depths, 0.75f, with(ShadowTechniques::choice<Vsm>)), 0.05f) << near;
  }
}

// The figures of docs/techniques/filtered-maps.md: what is left of MSM's rounding is that of the stored moments.
TEST(Prefiltered, Rounding_of_moments_in_32_bits_makes_msm_brighter_in_few_kernels_and_darker_in_none) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform;
  const PrefilteredText text = text_of(hamburger());
  const int sets = 20000;
  int moved = 0;
  double brightest = 0.0;
  for (int round = 0; round < sets; ++round) {
    Depths surfaces(1 + random() % 10);
    const float first = uniform(random) * 0.5f;
    const float spread = round % 2 == 0 ? 0.5f : 0.05f;
    for (float& z : surfaces) z = first + spread * uniform(random);
    Depths depths(25);
    for (float& z : depths) z = surfaces[random() % surfaces.size()];
    const float depth = round % 3 == 0 ? surfaces[0] : first + spread * uniform(random);
    // Both passes of the blur round.
    vec4 mean(0.0f);
    for (std::size_t row = 0; row < 5; ++row) {
      vec4 of_row(0.0f);
      for (std::size_t i = 0; i < 5; ++i) of_row += text.map_values(depths[5 * row + i], 0);
      mean += of_row / 5.0f;
    }
    mean /= 5.0f;
    const double found = text.visibility(dvec4(mean), static_cast<double>(depth));
    const double unrounded = text.visibility(exact_moments(depths), static_cast<double>(depth));
    if (std::abs(found - unrounded) > 1e-3) ++moved;
    brightest = std::max(brightest, found - unrounded);
    EXPECT_GE(found, exact(depths, depth) - 5e-5) << round;
  }
  EXPECT_LT(moved, sets * 15 / 1000);
  EXPECT_LT(brightest, 0.052);
}

}  // namespace
}  // namespace umbrameter
