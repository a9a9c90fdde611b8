#include <algorithm>
#include <array>
#include <limits>

#include "compare/metrics/metric.h"
#include "core/error.h"

namespace umbrameter {

std::span<const Metric> metrics() {
  static const std::array all = {mae_metric, rmse_metric, psnr_metric};
  return all;
}

std::string metric_names() {
  std::string names;
  for (const Metric& metric : metrics()) names += (names.empty() ? "" : ", ") + std::string(metric.name);
  return names;
}

std::vector<const Metric*> select_metrics(std::string_view names) {
  std::vector<const Metric*> selected;
  while (!names.empty()) {
    const std::string name(names.substr(0, names.find(',')));
    names.remove_prefix(std::min(names.size(), name.size() + 1));
    const auto found =
        std::find_if(metrics().begin(), metrics().end(), [&](const Metric& m) { return m.name == name; });
    if (found == metrics().end()) {
      throw Error(ExitCode::usage, "run.metrics", "there is no metric '" + name + "'",
                  "choose from: " + metric_names());
    }
    selected.push_back(&*found);
  }
  return selected;
}

MetricResult mean_of_pixels(const MetricInput& input, double (*of_pixel)(double test, double reference)) {
  MetricResult result;
  result.map = Image<float>(input.test.width, input.test.height, std::numeric_limits<float>::quiet_NaN());
  double sum = 0.0;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < input.test.size(); ++i) {
    if (!input.is_counted(i)) continue;
    const double value = of_pixel(static_cast<double>(input.test[i]), static_cast<double>(input.reference[i]));
    result.map[i] = static_cast<float>(value);
    sum += value;
    ++pixels;
  }
  result.score = pixels > 0 ? sum / static_cast<double>(pixels) : std::numeric_limits<double>::quiet_NaN();
  return result;
}

}  // namespace umbrameter
