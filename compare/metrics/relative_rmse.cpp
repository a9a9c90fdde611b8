#include <cmath>

#include "compare/metrics/metric.h"

namespace umbrameter {

// 0.01 keeps a dark reference from deciding the score.
const Metric relative_rmse_metric = {
    "relative-rmse",
    "relative root mean square error",
    "1",
    "0 and up, 0 is equal",
    "√(mean of (test − reference)² / (reference² + 0.01)); the map holds the quotients",
    "Rousselle, Knaus and Zwicker, Adaptive rendering with non-local means filtering, ACM TOG 31(6), 2012",
    false,
    [](const MetricInput& input) {
      MetricResult result = mean_of_pixels(input, [](double test, double reference) {
        return (test - reference) * (test - reference) / (reference * reference + 0.01);
      });
      result.score = std::sqrt(result.score);
      return result;
    }};

}  // namespace umbrameter
