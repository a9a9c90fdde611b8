// Metrics of colour images. A metric of scalar images (metric.h) applies here too, by its ColorRule.
#pragma once

#include <optional>

#include "compare/metrics/metric.h"
#include "core/math.h"

namespace umbrameter {

/// What the values of an image are.
enum class ImageContent {
  display,  ///< an image for a display, from a file of sRGB code values
  scene,    ///< linear radiance without an upper limit; a display shows it after an exposure and the sRGB curve
  data,     ///< numbers such as visibility and AO; compared as they are
};

struct ColorMetricParams {
  /// Of FLIP. By default those of a display 0.7 m wide with 3840 pixels, seen from 0.7 m: 3840 · π/180.
  double pixels_per_degree = 3840.0 * pi / 180.0;
  double exposure = 0.0;  ///< stops [EV] by which metrics of displayed images scale `scene` images
  /// Of HDR-FLIP [EV]; where absent, from the reference image.
  std::optional<double> start_exposure, stop_exposure;
  int exposures = 0;  ///< number of exposures of HDR-FLIP; 0: from start and stop
};

/// Two images of the same size, linear RGB (or data), and the pixels that count.
struct ColorInput {
  const Image<vec3>& test;
  const Image<vec3>& reference;
  std::function<bool(std::size_t)> is_counted;
  ImageContent content = ImageContent::display;
  ColorMetricParams params{};
};

/// All metrics.
std::span<const Metric> color_metrics();

/// The score of any metric and its map. A pixel's value is the mean of its channels where the metric compares each.
MetricResult measure_color(const Metric& metric, const ColorInput& input);

/// The score of any metric for scalar images, and its map. Metrics of colour see them as grey ImageContent::data.
MetricResult measure_scalar(const Metric& metric, const MetricInput& input);

/// Factor of the exposure for a display: 1 unless the content is `scene`.
float exposure_factor(const ColorInput& input);

/// Statistics of a map over its pixels that are not NaN; all NaN where there is none.
struct PooledMap {
  double mean = 0.0, min = 0.0, max = 0.0;
  ivec2 min_at{-1}, max_at{-1};  ///< first pixel with that value
  /// Nearest-rank percentiles: the least value that this share of the pixels does not exceed.
  double median = 0.0, percentile_95 = 0.0, percentile_99 = 0.0;
  /// The value at which the running sum of the sorted values exceeds this share of their sum: each value is weighted by
  /// itself, as FLIP's tool does. 0 where all values are 0.
  double weighted_quartile_1 = 0.0, weighted_median = 0.0, weighted_quartile_3 = 0.0;
};
PooledMap pool(const Image<float>& map);

}  // namespace umbrameter
