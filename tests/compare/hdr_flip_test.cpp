#include "compare/metrics/hdr_flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "compare/metrics/flip.h"
#include "core/error.h"

namespace umbrameter {
namespace {

MetricResult hdr_flip(const Image<vec3>& test, const Image<vec3>& reference, const ColorMetricParams& params = {}) {
  return measure_color(hdr_flip_metric,
                       {test, reference, [](std::size_t) { return true; }, ImageContent::scene, params});
}

/// 16 × 16 pixels: a quarter of them with the value `bright`, the others with `dark`.
Image<vec3> two_tones(float bright, float dark) {
  Image<vec3> image(16, 16, vec3(dark));
  for (std::size_t i = 0; i < 64; ++i) image[i] = vec3(bright);
  return image;
}

// 2.118873 solves (0.9036 x² + 0.018 x) = 0.85 (0.8748 x² + 0.354 x + 0.14).
TEST(HdrFlip, The_curve_reaches_85_percent_at_the_root_of_its_equation) { EXPECT_NEAR(aces(2.118873), 0.85, 1e-5); }

TEST(HdrFlip, Automatic_exposures_follow_maximum_and_median_luminance) {
  const ExposureRange range = exposure_range(two_tones(2.118873f * 8.0f, 2.118873f / 4.0f), {});
  EXPECT_NEAR(range.start, -3.0, 1e-5);
  EXPECT_NEAR(range.stop, 2.0, 1e-5);
  EXPECT_NEAR(range.count, 5, 1);                                  // 5 stops: rounding decides between 5 and 6
  EXPECT_EQ(exposure_range(two_tones(10.0f, 4.0f), {}).count, 2);  // log2(2.5) = 1.3 stops
  EXPECT_EQ(exposure_range(two_tones(41.0f, 4.0f), {}).count, 4);  // log2(10.25) = 3.4
}

TEST(HdrFlip, Given_exposures_replace_automatic_ones) {
  ColorMetricParams params;
  params.start_exposure = -1.5;
  params.stop_exposure = 2.0;
  EXPECT_EQ(exposure_range(two_tones(1.0f, 1.0f), params).count, 4);  // 3.5 stops
  params.exposures = 7;
  EXPECT_EQ(exposure_range(two_tones(1.0f, 1.0f), params).count, 7);
  params.start_exposure = 2.5;
  EXPECT_THROW(exposure_range(two_tones(1.0f, 1.0f), params), Error);
}

TEST(HdrFlip, A_reference_that_is_black_or_mostly_black_ends_with_finite_exposures) {
  const ExposureRange black = exposure_range(two_tones(0.0f, 0.0f), {});
  EXPECT_EQ(black.start, 0.0);
  EXPECT_EQ(black.stop, 0.0);
  EXPECT_EQ(black.count, 2);
  const ExposureRange mostly = exposure_range(two_tones(2.118873f, 0.0f), {});  // all lit pixels have one value
  EXPECT_NEAR(mostly.start, 0.0, 1e-5);
  EXPECT_NEAR(mostly.stop, 0.0, 1e-5);
  const MetricResult result = hdr_flip(two_tones(1.0f, 0.0f), two_tones(2.0f, 0.0f));
  EXPECT_GT(result.score, 0.0);
  EXPECT_LT(result.score, 1.0);
}

TEST(HdrFlip, Is_the_largest_ldr_flip_of_the_tone_mapped_images) {
  ColorMetricParams params;
  params.start_exposure = -2.0;
  params.stop_exposure = 2.0;
  params.exposures = 3;
  const auto ldr = [&](double exposure) {
    const auto mapped = [&](float value) {
      return Image<vec3>(16, 16, vec3(static_cast<float>(std::min(aces(std::exp2(exposure) * value), 1.0))));
    };
    return flip_map(mapped(0.2f), mapped(0.5f), params.pixels_per_degree)[0];
  };
  const MetricResult result = hdr_flip(Image<vec3>(16, 16, vec3(0.2f)), Image<vec3>(16, 16, vec3(0.5f)), params);
  EXPECT_NEAR(result.score, std::max({ldr(-2.0), ldr(0.0), ldr(2.0)}), 1e-6);
  EXPECT_EQ(result.details.at(2), (std::pair<std::string, double>{"exposures", 3.0}));
}

TEST(HdrFlip, Of_equal_images_is_0_and_very_bright_values_stay_finite) {
  EXPECT_EQ(hdr_flip(two_tones(50.0f, 0.01f), two_tones(50.0f, 0.01f)).score, 0.0);
  const double score = hdr_flip(two_tones(1e30f, 1.0f), two_tones(1e30f, 2.0f)).score;
  EXPECT_TRUE(std::isfinite(score));
}

}  // namespace
}  // namespace umbrameter
