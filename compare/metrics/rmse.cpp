#include <cmath>

#include "compare/metrics/metric.h"

namespace umbrameter {

const Metric rmse_metric = {
    "rmse",
    "root mean square error",
    "1",
    "0 to 1, 0 is equal",
    "√(mean of (test − reference)²); the map holds the squares",
    "Willmott and Matsuura, Advantages of the mean absolute error over the root mean square error, 2005",
    false,
    [](const MetricInput& input) {
      MetricResult result =
          mean_of_pixels(input, [](double test, double reference) { return (test - reference) * (test - reference); });
      result.score = std::sqrt(result.score);
      return result;
    }};

}  // namespace umbrameter
