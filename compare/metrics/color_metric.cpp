#include "compare/metrics/color_metric.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/metrics/color_space.h"
#include "core/parallel.h"

namespace umbrameter {
namespace {

// The values that a metric compares: the three channels one below the other.
Image<float> channel_values(const Image<vec3>& image, const ColorInput& input, ColorRule rule) {
  const bool code =
      input.content == ImageContent::display || (input.content == ImageContent::scene && rule != ColorRule::values);
  const double scale = rule == ColorRule::values ? 1.0 : static_cast<double>(exposure_factor(input));
  Image<float> values(image.width, 3 * image.height);
  parallel_for(3, [&](std::size_t channel) {
    for (std::size_t i = 0; i < image.size(); ++i) {
      const double value = static_cast<double>(image[i][static_cast<int>(channel)]);
      values[channel * image.size() + i] =
          static_cast<float>(code ? srgb_from_linear(std::clamp(scale * value, 0.0, 1.0)) : value);
    }
  });
  return values;
}

}  // namespace

float exposure_factor(const ColorInput& input) {
  return input.content == ImageContent::scene ? static_cast<float>(std::exp2(input.params.exposure)) : 1.0f;
}

MetricResult measure_color(const Metric& metric, const ColorInput& input) {
  if (metric.measure == nullptr) return metric.measure_color(input);
  const Image<float> test = channel_values(input.test, input, metric.color_rule);
  const Image<float> reference = channel_values(input.reference, input, metric.color_rule);
  const std::size_t pixels = input.test.size();
  MetricResult result = metric.measure({test, reference, [&](std::size_t i) { return input.is_counted(i % pixels); }});
  Image<float> mean(input.test.width, input.test.height);
  for (std::size_t i = 0; i < pixels; ++i) {
    mean[i] = (result.map[i] + result.map[pixels + i] + result.map[2 * pixels + i]) / 3.0f;
  }
  result.map = std::move(mean);
  return result;
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
  std::sort(values.begin(), values.end());
  pooled.mean = sum / static_cast<double>(values.size());
  const auto percentile = [&](double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    return static_cast<double>(values[std::max<std::size_t>(rank, 1) - 1]);
  };
  pooled.median = percentile(0.5);
  pooled.percentile_95 = percentile(0.95);
  pooled.percentile_99 = percentile(0.99);
  const auto weighted = [&](double share) {
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
