#include "experiments/measure_biases.h"

#include <algorithm>

#include "compare/bias_response.h"

namespace umbrameter {

std::vector<std::vector<VisibilityStatistics>> measure_biases(Stages& stages, const Experiment& experiment,
                                                              std::uint32_t light, const std::vector<double>& constant,
                                                              const std::vector<double>& slope) {
  BiasAxes axes;
  axes.unit = experiment.shadow.bias.constant.unit;
  for (const double bias : constant) axes.constant.push_back(static_cast<float>(bias));
  for (const double factor : slope) axes.slope.push_back(static_cast<float>(factor));
  std::sort(axes.constant.begin(), axes.constant.end());
  axes.constant.erase(std::unique(axes.constant.begin(), axes.constant.end()), axes.constant.end());

  const BiasHistogram histogram = stages.bias_response(experiment, light, axes);
  const TruthCounts truth = count_truth(stages.truth(experiment, light).visibility, stages.counted(experiment, light));
  std::vector<std::vector<VisibilityStatistics>> measured(slope.size());
  for (std::size_t s = 0; s < slope.size(); ++s) {
    const std::vector<VisibilityStatistics> ascending = statistics_at_biases(histogram, s, truth);
    for (const double bias : constant) {
      const auto found = std::lower_bound(axes.constant.begin(), axes.constant.end(), static_cast<float>(bias));
      measured[s].push_back(ascending[static_cast<std::size_t>(found - axes.constant.begin())]);
    }
  }
  return measured;
}

}  // namespace umbrameter
