#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/metrics/color_metric.h"
#include "core/error.h"
#include "core/lists.h"

namespace umbrameter {

std::span<const Metric> color_metrics() {
  static const std::vector<Metric> all = listed_metrics();
  return all;
}

std::span<const Metric> metrics() {
  const std::span<const Metric> all = color_metrics();
  const auto end = std::ranges::find(all, nullptr, &Metric::measure);
  return {all.begin(), end};
}

std::string name_in_unit(const Metric& metric, std::string_view unit) {
  return std::string(metric.name) + "-" + std::string(unit);
}

std::string metric_names(std::span<const Metric> all) { return joined(all, ", ", &Metric::name); }

std::vector<const Metric*> select_metrics(std::string_view names, std::span<const Metric> all,
                                          const std::string& option) {
  std::vector<const Metric*> selected;
  while (!names.empty()) {
    const std::string name(names.substr(0, names.find(',')));
    names.remove_prefix(std::min(names.size(), name.size() + 1));
    const auto found = std::ranges::find(all, name, &Metric::name);
    if (found == all.end()) {
      throw Error(ExitCode::usage, option, "there is no metric '" + name + "'", "choose from: " + metric_names(all));
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

MetricResult mean_of_map(Image<float> map, const std::function<bool(std::size_t)>& is_counted) {
  MetricResult result;
  double sum = 0.0;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (!is_counted(i)) map[i] = std::numeric_limits<float>::quiet_NaN();
    if (std::isnan(map[i])) continue;
    sum += static_cast<double>(map[i]);
    ++pixels;
  }
  result.score = pixels > 0 ? sum / static_cast<double>(pixels) : std::numeric_limits<double>::quiet_NaN();
  result.map = std::move(map);
  return result;
}

}  // namespace umbrameter
