#include "results/tune_results.h"

#include "experiments/settings/sweep_plan.h"

namespace umbrameter {

std::optional<double> recommended_bias(const TuneResult& result) {
  if (!result.plateau || result.withheld || !result.plateau->has_little_acne()) return std::nullopt;
  return result.plateau->recommended.constant;
}

std::vector<Value> values_to_use(const TuneSummary& summary) {
  std::vector<Value> values = summary.result.best.values;
  const std::optional<double> bias = recommended_bias(summary.result);
  for (std::size_t a = 0; bias && a < values.size(); ++a) {
    if (summary.axes[a].key() == constant_bias_key) values[a] = *bias;
  }
  return values;
}

}  // namespace umbrameter
