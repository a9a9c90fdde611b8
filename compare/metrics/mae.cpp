#include <cmath>

#include "compare/metrics/metric.h"

namespace umbrameter {

const Metric mae_metric = {
    "mae",
    "mean absolute error",
    "1",
    "0 to 1, 0 is equal",
    "mean of |test − reference|",
    "Willmott and Matsuura, Advantages of the mean absolute error over the root mean square error, 2005",
    false,
    [](const MetricInput& input) {
      return mean_of_pixels(input, [](double test, double reference) { return std::abs(test - reference); });
    }};

}  // namespace umbrameter
