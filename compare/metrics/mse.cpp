#include "compare/metrics/metric.h"

namespace umbrameter {

const Metric mse_metric = {
    "mse",
    "mean square error",
    "1",
    "0 to 1, 0 is equal",
    "mean of (test − reference)²",
    "Wang and Bovik, Mean squared error: love it or leave it?, IEEE Signal Processing Magazine 26(1), 2009",
    false,
    [](const MetricInput& input) {
      return mean_of_pixels(input,
                            [](double test, double reference) { return (test - reference) * (test - reference); });
    }};

}  // namespace umbrameter
