#include "compare/metrics/ssim.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compare/metrics/color_metric.h"

namespace umbrameter {
namespace {

bool every_pixel(std::size_t) { return true; }

MetricResult measure(const Metric& metric, const Image<float>& test, const Image<float>& reference) {
  return metric.measure({test, reference, every_pixel});
}

/// Columns of a and b in turn.
Image<float> stripes(int width, int height, float a, float b) {
  Image<float> image(width, height, a);
  for (int y = 0; y < height; ++y) {
    for (int x = 1; x < width; x += 2) image.at(x, y) = b;
  }
  return image;
}

TEST(Ssim, Of_equal_images_is_1) {
  const Image<float> image = stripes(200, 180, 0.2f, 0.7f);
  for (const Metric* metric : {&ssim_metric, &ssim_uniform_metric, &ms_ssim_metric}) {
    EXPECT_NEAR(measure(*metric, image, image).score, 1.0, 1e-6) << metric->name;
  }
}

// Nearly equal images of 0 and 1: rounded means of squares would make it 1.0001.
TEST(Ssim, Is_at_most_1) {
  Image<float> test(64, 64);
  for (std::size_t i = 0; i < test.size(); ++i) test[i] = i * 7919 % 13 < 3 ? 1.0f : 0.999f;
  Image<float> reference = test;
  for (std::size_t i = 0; i < test.size(); i += 5) reference[i] -= 1e-4f;
  const Image<float> map = measure(ssim_metric, test, reference).map;
  for (const float value : map.pixels) EXPECT_FALSE(value > 1.0f) << value;
}

TEST(Ssim, Of_constant_images_is_the_luminance_term) {
  const Image<float> test(200, 180, 0.25f);
  const Image<float> reference(200, 180, 0.75f);
  const double luminance = (2.0 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4);
  EXPECT_NEAR(measure(ssim_metric, test, reference).score, luminance, 1e-5);
  EXPECT_NEAR(measure(ssim_uniform_metric, test, reference).score, luminance, 1e-5);
  EXPECT_NEAR(measure(ms_ssim_metric, test, reference).score, std::pow(luminance, 0.1333), 1e-5);
}

// A 7 × 7 image has one window. 28 pixels of 0.2 and 21 of 0.6; the other image has 0.4 everywhere.
TEST(Ssim, Of_one_uniform_window_follows_its_formula) {
  const Image<float> test = stripes(7, 7, 0.2f, 0.6f);
  const Image<float> reference(7, 7, 0.4f);
  const double mean = (28.0 * 0.2 + 21.0 * 0.6) / 49.0;
  const double variance = (28.0 * std::pow(0.2 - mean, 2) + 21.0 * std::pow(0.6 - mean, 2)) / 48.0;
  const double expected = (2.0 * mean * 0.4 + 1e-4) / (mean * mean + 0.16 + 1e-4) * 9e-4 / (variance + 9e-4);
  const MetricResult result = measure(ssim_uniform_metric, test, reference);
  EXPECT_NEAR(result.score, expected, 1e-6);
  EXPECT_NEAR(result.map.at(3, 3), expected, 1e-6);
  EXPECT_TRUE(std::isnan(result.map.at(2, 3)));
}

// With opposite stripes the covariance is −variance; the weights of a Gaussian window make the means differ.
TEST(Ssim, Of_one_gaussian_window_follows_its_formula) {
  const Image<float> test = stripes(11, 11, 0.3f, 0.7f);
  const Image<float> reference = stripes(11, 11, 0.7f, 0.3f);
  double odd = 0.0;  // weight of the columns 1, 3, 5, …: distances 0, 2 and 4
  double all = 0.0;
  for (int d = -5; d <= 5; ++d) {
    const double weight = std::exp(-d * d / 4.5);
    all += weight;
    if (d % 2 == 0) odd += weight;
  }
  odd /= all;
  const double mx = 0.3 + 0.4 * odd;
  const double my = 0.7 - 0.4 * odd;
  const double variance = 0.16 * odd * (1.0 - odd);
  const double expected =
      (2.0 * mx * my + 1e-4) / (mx * mx + my * my + 1e-4) * (-2.0 * variance + 9e-4) / (2.0 * variance + 9e-4);
  EXPECT_NEAR(measure(ssim_metric, test, reference).score, expected, 1e-6);
}

TEST(Ssim, Has_no_value_where_no_window_fits) {
  EXPECT_TRUE(std::isnan(measure(ssim_metric, Image<float>(10, 40), Image<float>(10, 40)).score));
  EXPECT_TRUE(std::isnan(measure(ms_ssim_metric, Image<float>(175, 400), Image<float>(175, 400)).score));
  EXPECT_NEAR(measure(ms_ssim_metric, Image<float>(176, 176), Image<float>(176, 176)).score, 1.0, 1e-6);
}

TEST(Ssim, Maps_average_to_the_score) {
  const Image<float> test = stripes(60, 40, 0.3f, 0.7f);
  const Image<float> reference(60, 40, 0.5f);
  for (const Metric* metric : {&ssim_metric, &ssim_uniform_metric}) {
    const MetricResult result = measure(*metric, test, reference);
    EXPECT_NEAR(pool(result.map).mean, result.score, 1e-12) << metric->name;
  }
}

// Only the finest scale sees stripes one pixel wide: the means of 2 × 2 pixels are equal.
TEST(MsSsim, Of_a_detail_that_the_second_scale_does_not_hold_is_a_power_of_the_first_scale) {
  const Image<float> test = stripes(192, 192, 0.3f, 0.7f);
  const Image<float> reference(192, 192, 0.5f);
  const SsimMaps maps = ssim_maps(test, reference, ssim_window());
  EXPECT_NEAR(measure(ms_ssim_metric, test, reference).score, std::pow(pool(maps.contrast_structure).mean, 0.0448),
              1e-5);
}

TEST(Ssim, Of_colour_images_reads_the_luma_or_each_channel) {
  const Image<vec3> reference(32, 32, vec3(0.5f));
  Image<vec3> test = reference;
  for (vec3& color : test.pixels) color.b = 0.25f;
  const auto score = [&](const Metric& metric) {
    return measure_color(metric, {test, reference, every_pixel, ImageContent::data, {}}).score;
  };
  const auto luminance = [](double a, double b) { return (2.0 * a * b + 1e-4) / (a * a + b * b + 1e-4); };
  EXPECT_NEAR(score(ssim_metric), luminance(0.5, 0.5 - 0.114 * 0.25), 1e-5);
  EXPECT_NEAR(score(ssim_uniform_metric), (2.0 + luminance(0.5, 0.25)) / 3.0, 1e-5);
}

}  // namespace
}  // namespace umbrameter
