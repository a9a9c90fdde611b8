#include "compare/unresolved_taps.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace umbrameter {
namespace {

constexpr std::uint32_t at(std::uint32_t x, std::uint32_t y) { return x | y << 16u; }

TEST(UnresolvedTaps, A_tap_that_is_on_the_same_surface_turns_from_false_occlusion_to_acne_at_its_pixel) {
  const GBuffer gbuffer(2, 3);
  WrongTaps wrong{Image<uvec4>(2, 3, uvec4(0)), 8};
  wrong.weights.at(1, 2) = uvec4(1, 5, 0, 0);  // the bottom row, which taps count as 0
  wrong.weights.at(0, 0) = uvec4(0, 4, 0, 0);
  const std::vector<UnresolvedTap> taps = {{at(1, 0), 0, 0, 3}, {at(1, 0), 1, 0, 2}, {at(0, 2), 2, 0, 4}};
  const std::vector<std::uint8_t> is_same_surface = {1, 0, 1};
  reclassify(wrong, gbuffer, taps, is_same_surface);
  EXPECT_EQ(wrong.weights.at(1, 2), uvec4(4, 2, 0, 0));
  EXPECT_EQ(wrong.weights.at(0, 0), uvec4(4, 0, 0, 0));

  ClassAgreement agreement;
  agreement.wrong = 10;
  add_reclassified(agreement, taps, is_same_surface);
  EXPECT_EQ(agreement.taps, 3u);
  EXPECT_DOUBLE_EQ(share_of_unresolved(agreement), 7.0 / 9.0);
  EXPECT_DOUBLE_EQ(share_of_wrong(agreement), 0.7);
  EXPECT_EQ(share_of_unresolved({}), 0.0);
}

TEST(UnresolvedTaps, In_a_histogram_it_turns_in_the_bin_of_its_flip_at_every_slope) {
  // A tap of critical bias 0.25 on a pixel of slope 0.1 flips at 0.25, and with slope factor 2 at 0.05: blocked at one
  // and at none of the biases 0.1 and 0.3.
  BiasHistogram histogram;
  histogram.axes = {{0.1f, 0.3f}, {0.0f, 2.0f}};
  histogram.by_slope.assign(2, std::vector<BiasHistogram::Bin>(3));
  histogram.by_slope[0][1].weights = {0, 6, 0, 0};
  histogram.by_slope[0][1].squares = {36, 0};
  const BiasHistogram before = histogram;
  const std::vector<UnresolvedTap> taps = {{0, 0, 0, 5, 0.25f, 0.1f}};
  reclassify(histogram, taps, std::vector<std::uint8_t>{0});
  EXPECT_EQ(histogram.by_slope, before.by_slope);
  reclassify(histogram, taps, std::vector<std::uint8_t>{1});
  EXPECT_EQ(histogram.by_slope[0][1].weights, (std::array<std::uint64_t, 4>{5, 1, 0, 0}));
  EXPECT_EQ(histogram.by_slope[0][1].squares, before.by_slope[0][1].squares);
  EXPECT_EQ(histogram.by_slope[1], before.by_slope[1]);
}

TEST(UnresolvedTaps, A_tap_that_was_not_counted_is_an_error_and_wraps_no_weight) {
  const GBuffer gbuffer(1, 1);
  WrongTaps wrong{Image<uvec4>(1, 1, uvec4(0, 2, 0, 0)), 8};
  const std::vector<UnresolvedTap> taps = {{0, 0, 0, 3, 0.25f, 0.1f}};
  const std::vector<std::uint8_t> is_same_surface = {1};
  EXPECT_THROW(reclassify(wrong, gbuffer, taps, is_same_surface), Error);
  EXPECT_EQ(wrong.weights[0], uvec4(0, 2, 0, 0));

  BiasHistogram histogram;
  histogram.axes = {{0.1f}, {0.0f}};
  histogram.by_slope.assign(1, std::vector<BiasHistogram::Bin>(2));
  EXPECT_THROW(reclassify(histogram, taps, is_same_surface), Error);
  EXPECT_EQ(histogram.by_slope[0][1].weights, (std::array<std::uint64_t, 4>{}));
}

}  // namespace
}  // namespace umbrameter
