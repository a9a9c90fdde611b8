#include "compare/metrics/color_metric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "compare/metrics/color_space.h"
#include "core/parallel.h"

namespace umbrameter {
namespace {

// The values of an image that a metric compares, channel by channel.
std::array<Image<float>, 3> channels(const Image<vec3>& image, const ColorInput& input, ColorRule rule) {
  const bool code =
      input.content == ImageContent::display || (input.content == ImageContent::scene && rule != ColorRule::values);
  const double scale = rule == ColorRule::values ? 1.0 : static_cast<double>(exposure_factor(input));
  std::array<Image<float>, 3> result;
  parallel_for(3, [&](std::size_t channel) {
    result[channel] = Image<float>(image.width, image.height);
    for (std::size_t i = 0; i < image.size(); ++i) {
      const double value = static_cast<double>(image[i][static_cast<int>(channel)]);
      result[channel][i] = static_cast<float>(code ? srgb_from_linear(std::clamp(scale * value, 0.0, 1.0)) : value);
    }
  });
  return result;
}

// One below the other, so that a mean over the pixels is a mean over all values.
Image<float> stacked(const std::array<Image<float>, 3>& planes) {
  Image<float> result(planes[0].width, 3 * planes[0].height);
  auto end = result.pixels.begin();
  for (const Image<float>& plane : planes) end = std::copy(plane.pixels.begin(), plane.pixels.end(), end);
  return result;
}

Image<float> luma(const std::array<Image<float>, 3>& planes) {
  Image<float> result = planes[1];
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = 0.299f * planes[0][i] + 0.587f * planes[1][i] + 0.114f * planes[2][i];
  }
  return result;
}

Image<float> mean_of_three(std::size_t pixels, const Image<float>& like, const auto& value) {
  Image<float> mean(like.width, like.height);
  for (std::size_t i = 0; i < pixels; ++i) mean[i] = (value(0, i) + value(1, i) + value(2, i)) / 3.0f;
  return mean;
}

}  // namespace

float exposure_factor(const ColorInput& input) {
  return input.content == ImageContent::scene ? static_cast<float>(std::exp2(input.params.exposure)) : 1.0f;
}

MetricResult measure_color(const Metric& metric, const ColorInput& input) {
  if (metric.measure == nullptr) return metric.measure_color(input);
  const std::array test = channels(input.test, input, metric.color_rule);
  const std::array reference = channels(input.reference, input, metric.color_rule);
  const std::size_t pixels = input.test.size();
  if (metric.color_rule == ColorRule::display_luma) {
    return metric.measure({luma(test), luma(reference), input.is_counted});
  }
  if (metric.color_rule == ColorRule::display_channels) {
    std::array<MetricResult, 3> each;
    for (std::size_t c = 0; c < 3; ++c) each[c] = metric.measure({test[c], reference[c], input.is_counted});
    return {(each[0].score + each[1].score + each[2].score) / 3.0,
            mean_of_three(pixels, test[0], [&](std::size_t c, std::size_t i) { return each[c].map[i]; })};
  }
  MetricResult result =
      metric.measure({stacked(test), stacked(reference), [&](std::size_t i) { return input.is_counted(i % pixels); }});
  result.map = mean_of_three(pixels, test[0], [&](std::size_t c, std::size_t i) { return result.map[c * pixels + i]; });
  return result;
}

MetricResult measure_scalar(const Metric& metric, const MetricInput& input) {
  if (metric.measure != nullptr) return metric.measure(input);
  const auto grey = [](const Image<float>& image) {
    Image<vec3> color(image.width, image.height);
    std::transform(image.pixels.begin(), image.pixels.end(), color.pixels.begin(), [](float v) { return vec3(v); });
    return color;
  };
  return metric.measure_color({grey(input.test), grey(input.reference), input.is_counted, ImageContent::data});
}

PooledMap pool(const Image<float>& map) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PooledMap pooled{nan, nan, nan, ivec2(-1), ivec2(-1), nan, nan, nan, nan, nan, nan};
  std::vector<float> values;
  double sum = 0.0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    const float value = map[i];
    if (std::isnan(value)) continue;
    const ivec2 at(static_cast<int>(i) % map.width, static_cast<int>(i) / map.width);
    const double number = static_cast<double>(value);
    if (values.empty() || number < pooled.min) pooled.min = number, pooled.min_at = at;
    if (values.empty() || number > pooled.max) pooled.max = number, pooled.max_at = at;
    sum += number;
    values.push_back(value);
  }
  if (values.empty()) return pooled;
  std::ranges::sort(values);
  pooled.mean = sum / static_cast<double>(values.size());
  const auto percentile = [&](double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    return static_cast<double>(values[std::max<std::size_t>(rank, 1) - 1]);
  };
  pooled.median = percentile(0.5);
  pooled.percentile_95 = percentile(0.95);
  pooled.percentile_99 = percentile(0.99);
  const auto weighted = [&](double share) {
    if (pooled.min < 0.0) return nan;  // values of either sign cancel in the sum
    double running = 0.0;
    for (const float value : values) {
      running += static_cast<double>(value);
      if (running > share * sum) return static_cast<double>(value);
    }
    return 0.0;
  };
  pooled.weighted_quartile_1 = weighted(0.25);
  pooled.weighted_median = weighted(0.5);
  pooled.weighted_quartile_3 = weighted(0.75);
  return pooled;
}

}  // namespace umbrameter
