// Image metrics: each is one file that yields map and score from one call, and one line in metrics.cpp.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"

namespace umbrameter {

/// Two images of one size, values from 0 to 1, and the pixels that count. Called from any thread.
struct MetricInput {
  const Image<float>& test;
  const Image<float>& reference;
  std::function<bool(std::size_t)> is_counted;
};

struct MetricResult {
  double score = 0.0;  ///< NaN where no pixel counts
  Image<float> map;    ///< the contribution of each pixel; NaN where it does not count
};

struct Metric {
  std::string_view name;     ///< as keys write it: "psnr"
  std::string_view title;    ///< "peak signal-to-noise ratio"
  std::string_view unit;     ///< "1", "dB"
  std::string_view range;    ///< "0 to 1, 0 is equal"
  std::string_view formula;  ///< of the score
  std::string_view source;   ///< where it is defined
  bool is_higher_better = false;
  MetricResult (*measure)(const MetricInput& input) = nullptr;
};

/// All of them.
std::span<const Metric> metrics();

/// Their names: "mae, rmse".
std::string metric_names();

/// The metrics of a comma-separated list of names. Throws Error (usage) that suggests what may be meant.
std::vector<const Metric*> select_metrics(std::string_view names);

/// The map of a function of test and reference, and its mean over the counted pixels.
MetricResult mean_of_pixels(const MetricInput& input, double (*of_pixel)(double test, double reference));

extern const Metric mae_metric;
extern const Metric rmse_metric;
extern const Metric psnr_metric;

}  // namespace umbrameter
