#include <cmath>

#include "compare/metrics/metric.h"

namespace umbrameter {

const Metric psnr_metric = {
    "psnr",
    "peak signal-to-noise ratio",
    "dB",
    "0 dB and up, infinite is equal",
    "−10 · log10(mean of (test − reference)²), for a peak of 1; the map holds the squares",
    "Wang and Bovik, Mean squared error: love it or leave it?, IEEE Signal Processing Magazine 26(1), 2009",
    true,
    [](const MetricInput& input) {
      MetricResult result = rmse_metric.measure(input);
      result.score = -20.0 * std::log10(result.score);
      return result;
    },
    ColorRule::display_values};

}  // namespace umbrameter
