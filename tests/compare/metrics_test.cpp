#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "compare/metrics/metric.h"
#include "core/error.h"

namespace umbrameter {
namespace {

double score(const std::string& name, const Image<float>& test, const Image<float>& reference) {
  const auto all = [](std::size_t) { return true; };
  return select_metrics(name).front()->measure({test, reference, all}).score;
}

TEST(Metrics, Of_a_constant_difference_follow_their_formulas) {
  const Image<float> reference(4, 3, 0.25f);
  const Image<float> test(4, 3, 0.375f);  // 1/8 more, exact in binary
  EXPECT_EQ(score("mae", test, reference), 0.125);
  EXPECT_EQ(score("rmse", test, reference), 0.125);
  EXPECT_EQ(score("mse", test, reference), 0.015625);
  EXPECT_NEAR(score("relative-rmse", test, reference), 0.464238, 1e-6);  // 0.125 / √(0.0625 + 0.01)
  EXPECT_NEAR(score("psnr", test, reference), 18.0618, 1e-4);            // −20 log10(1/8) = 60 log10 2
}

TEST(Metrics, Of_equal_images_are_perfect) {
  const Image<float> image(4, 3, 0.25f);
  EXPECT_EQ(score("mae", image, image), 0.0);
  EXPECT_EQ(score("rmse", image, image), 0.0);
  EXPECT_EQ(score("psnr", image, image), std::numeric_limits<double>::infinity());
}

TEST(Metrics, Read_only_the_counted_pixels) {
  const Image<float> reference(2, 1, 0.0f);
  Image<float> test(2, 1, 0.0f);
  test[1] = 1.0f;
  for (const Metric& metric : metrics()) {
    const MetricResult one = metric.measure({test, reference, [](std::size_t i) { return i == 1; }});
    EXPECT_TRUE(std::isnan(one.map[0])) << metric.name;
    const MetricResult none = metric.measure({test, reference, [](std::size_t) { return false; }});
    EXPECT_TRUE(std::isnan(none.score)) << metric.name;
  }
  const auto at_1 = [](std::size_t i) { return i == 1; };
  for (const Metric* metric : {&mae_metric, &mse_metric, &rmse_metric}) {
    const MetricResult one = metric->measure({test, reference, at_1});
    EXPECT_EQ(one.score, 1.0) << metric->name;
    EXPECT_EQ(one.map[1], 1.0f) << metric->name;
  }
  EXPECT_EQ(psnr_metric.measure({test, reference, at_1}).score, 0.0);
}

TEST(Metrics, Of_windows_count_the_windows_whose_centre_counts) {
  const Image<float> reference(31, 31, 0.5f);
  Image<float> test = reference;
  for (int y = 0; y < 31; ++y) test.at(30, y) = 1.0f;  // windows of 11 pixels around columns 5 to 24 do not reach it
  const auto score = [&](int first, int last) {
    return ssim_metric
        .measure({test, reference,
                  [=](std::size_t i) { return static_cast<int>(i % 31) >= first && static_cast<int>(i % 31) <= last; }})
        .score;
  };
  EXPECT_NEAR(score(0, 24), 1.0, 1e-6);
  EXPECT_LT(score(25, 30), 0.9);
  EXPECT_TRUE(std::isnan(score(26, 30)));  // their windows leave the image
}

TEST(Metrics, Are_described_and_have_a_name_each) {
  std::set<std::string_view> names;
  for (const Metric& metric : metrics()) {
    EXPECT_TRUE(names.insert(metric.name).second) << metric.name;
    for (const std::string_view text : {metric.title, metric.unit, metric.range, metric.formula, metric.source}) {
      EXPECT_FALSE(text.empty()) << metric.name;
    }
  }
}

TEST(Metrics, An_unknown_name_is_an_error_that_lists_the_known_ones) {
  EXPECT_TRUE(select_metrics("").empty());
  EXPECT_EQ(select_metrics("psnr,mae").size(), 2u);
  try {
    select_metrics("mae,ssmi");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find(metric_names()), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace umbrameter
