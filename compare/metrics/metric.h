// Image metrics. Each computes an error map and a score in one call. To add one: a new file, its declaration at the end
// of this header, and a line in metrics.cpp.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"

namespace umbrameter {

/// Two images of the same size with values from 0 to 1, and the pixels that count. is_counted() is called from any
/// thread.
struct MetricInput {
  const Image<float>& test;
  const Image<float>& reference;
  std::function<bool(std::size_t)> is_counted;
};

struct MetricResult {
  double score = 0.0;  ///< NaN if no pixel counts
  Image<float> map;    ///< the contribution of each pixel; NaN if it does not count
};

struct Metric {
  std::string_view name;     ///< name in keys: "psnr"
  std::string_view title;    ///< "peak signal-to-noise ratio"
  std::string_view unit;     ///< "1", "dB"
  std::string_view range;    ///< "0 to 1, 0 is equal"
  std::string_view formula;  ///< formula of the score
  std::string_view source;   ///< publication that defines it
  bool is_higher_better = false;
  MetricResult (*measure)(const MetricInput& input) = nullptr;
};

/// All metrics.
std::span<const Metric> metrics();

/// The names of all metrics: "mae, rmse".
std::string metric_names();

/// The metrics of a comma-separated list of names. For an unknown name, throws Error (usage) that suggests a similar
/// one.
std::vector<const Metric*> select_metrics(std::string_view names);

/// Applies a function of test and reference to every counted pixel. The score is its mean.
MetricResult mean_of_pixels(const MetricInput& input, double (*of_pixel)(double test, double reference));

extern const Metric mae_metric;
extern const Metric rmse_metric;
extern const Metric psnr_metric;

}  // namespace umbrameter
