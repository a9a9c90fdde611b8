#include <gtest/gtest.h>

#include <cmath>

#include "compare/metrics/color_metric.h"

namespace umbrameter {
namespace {

bool all_pixels(std::size_t) { return true; }

Image<vec3> constant(int width, int height, float value) { return Image<vec3>(width, height, vec3(value)); }

/// White from column x on, black before it.
Image<vec3> step(int size, int x) {
  Image<vec3> image(size, size);
  for (int row = 0; row < size; ++row) {
    for (int column = x; column < size; ++column) image.at(column, row) = vec3(1.0f);
  }
  return image;
}

MetricResult flip(const Image<vec3>& test, const Image<vec3>& reference, const ColorMetricParams& params = {}) {
  return measure_color(ldr_flip_metric, {test, reference, all_pixels, ImageContent::display, params});
}

// The reference implementation computes in single precision and gives .967388, .951377, .051732 and .772917; exact
// arithmetic gives .967380, .951367 and .051723. Both are right to 1.2e-5.
TEST(LdrFlip, Of_constant_images_and_of_a_moved_edge_are_those_of_the_reference_implementation) {
  EXPECT_NEAR(flip(constant(32, 32, 0.0f), constant(32, 32, 1.0f)).score, 0.967380, 2e-6);
  EXPECT_NEAR(flip(constant(32, 32, 0.1f), constant(32, 32, 0.9f)).score, 0.951367, 2e-6);
  const MetricResult edge = flip(step(64, 33), step(64, 32));
  EXPECT_NEAR(edge.score, 0.051723, 2e-6);
  EXPECT_NEAR(pool(edge.map).max, 0.772917, 1.2e-5);
}

TEST(LdrFlip, Of_equal_images_is_0_and_so_are_its_weighted_quartiles) {
  const MetricResult result = flip(step(40, 13), step(40, 13));
  EXPECT_EQ(result.score, 0.0);
  const PooledMap pooled = pool(result.map);
  EXPECT_EQ(pooled.max, 0.0);
  EXPECT_EQ(pooled.weighted_quartile_1, 0.0);
  EXPECT_EQ(pooled.weighted_median, 0.0);
  EXPECT_EQ(pooled.weighted_quartile_3, 0.0);
}

TEST(LdrFlip, Does_not_change_when_the_images_are_exchanged_or_both_mirrored) {
  const auto scene = [](float shift) {
    Image<vec3> image(37, 29);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const float t = 0.3f * static_cast<float>(x) + 0.2f * static_cast<float>(y) + shift;
        image.at(x, y) = 0.5f + 0.4f * vec3(std::sin(t), std::cos(1.3f * t), std::sin(0.7f * t));
      }
    }
    return image;
  };
  const auto mirrored = [](const Image<vec3>& image) {
    Image<vec3> result = image;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) result.at(x, y) = image.at(image.width - 1 - x, image.height - 1 - y);
    }
    return result;
  };
  const Image<vec3> a = scene(0.0f);
  const Image<vec3> b = scene(0.4f);
  const double score = flip(a, b).score;
  EXPECT_GT(score, 0.05);
  EXPECT_NEAR(flip(b, a).score, score, 1e-7);
  EXPECT_NEAR(flip(mirrored(a), mirrored(b)).score, score, 1e-6);
}

TEST(LdrFlip, A_small_detail_fades_when_the_viewer_moves_away) {
  Image<vec3> dot = constant(41, 41, 0.2f);
  dot.at(20, 20) = vec3(1.0f);
  ColorMetricParams near, far;
  near.pixels_per_degree = 20.0;
  far.pixels_per_degree = 120.0;
  EXPECT_GT(pool(flip(dot, constant(41, 41, 0.2f), near).map).max,
            1.2 * pool(flip(dot, constant(41, 41, 0.2f), far).map).max);
}

TEST(LdrFlip, Clamps_to_what_a_display_shows_and_counts_only_the_mask) {
  EXPECT_EQ(flip(constant(16, 16, 1.0f), constant(16, 16, 7.0f)).score, 0.0);
  const Image<vec3> test = step(64, 33);
  const Image<vec3> reference = step(64, 32);
  const MetricResult left = measure_color(
      ldr_flip_metric, {test, reference, [](std::size_t i) { return i % 64 < 8; }, ImageContent::display, {}});
  EXPECT_EQ(left.score, 0.0);  // the filters reach 10 pixels, the edge is 24 away
  EXPECT_TRUE(std::isnan(left.map[32]));
}

TEST(PooledMap, Of_values_below_0_has_no_quartiles_of_their_sum) {
  Image<float> map(4, 1);
  map.pixels = {-1.0f, 0.0f, 0.0f, 1.0f};
  const PooledMap pooled = pool(map);
  EXPECT_EQ(pooled.median, 0.0);
  for (const double value : {pooled.weighted_quartile_1, pooled.weighted_median, pooled.weighted_quartile_3})
    EXPECT_TRUE(std::isnan(value));
}

TEST(PooledMap, Weights_each_value_by_itself) {
  Image<float> map(5, 1);
  map.pixels = {4.0f, 1.0f, 2.0f, std::nanf(""), 3.0f};  // sum 10; running 1, 3, 6, 10
  const PooledMap pooled = pool(map);
  EXPECT_EQ(pooled.mean, 2.5);
  EXPECT_EQ(pooled.min, 1.0);
  EXPECT_EQ(pooled.min_at, ivec2(1, 0));
  EXPECT_EQ(pooled.max, 4.0);
  EXPECT_EQ(pooled.max_at, ivec2(0, 0));
  EXPECT_EQ(pooled.median, 2.0);
  EXPECT_EQ(pooled.percentile_95, 4.0);
  EXPECT_EQ(pooled.weighted_quartile_1, 2.0);  // running 3 exceeds 2.5
  EXPECT_EQ(pooled.weighted_median, 3.0);      // running 6 exceeds 5
  EXPECT_EQ(pooled.weighted_quartile_3, 4.0);
  EXPECT_TRUE(std::isnan(pool(Image<float>(2, 1, std::nanf(""))).weighted_median));
}

TEST(ColorMetrics, Of_pixel_differences_read_code_values_of_display_images_and_linear_values_of_others) {
  // Linear 0.0212 and 0.2140 are sRGB 0.1568 and 0.5000; a difference in one of three channels.
  const Image<vec3> reference(2, 1, vec3(0.0212f));
  Image<vec3> test = reference;
  test[0].g = test[1].g = 0.2140f;
  const auto score = [&](const Metric& metric, ImageContent content) {
    return measure_color(metric, {test, reference, all_pixels, content, {}}).score;
  };
  EXPECT_NEAR(score(mae_metric, ImageContent::scene), 0.1928 / 3.0, 1e-6);
  EXPECT_NEAR(score(mae_metric, ImageContent::display), 0.3432 / 3.0, 1e-4);
  EXPECT_NEAR(score(mae_metric, ImageContent::data), 0.1928 / 3.0, 1e-6);
  EXPECT_NEAR(score(psnr_metric, ImageContent::scene), -10.0 * std::log10(0.3432 * 0.3432 / 3.0), 0.01);
  EXPECT_NEAR(score(psnr_metric, ImageContent::data), -10.0 * std::log10(0.1928 * 0.1928 / 3.0), 0.01);
}

}  // namespace
}  // namespace umbrameter
