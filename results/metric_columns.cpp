#include "results/metric_columns.h"

#include <algorithm>
#include <utility>

namespace umbrameter {
namespace {

// Of the metric rmse in a run, whose statistic rmse is corrected for the variance of the reference.
constexpr std::string_view uncorrected_rmse = "rmse-uncorrected";

}  // namespace

std::string MetricColumn::meaning() const {
  return std::string(metric->title) + "; " + std::string(metric->range) +
         (metric->is_higher_better ? ", higher is better" : "");
}

std::vector<MetricColumn> columns_of(const Metric& metric, bool is_shadow) {
  const std::string_view name = metric.name == rmse_metric.name ? uncorrected_rmse : metric.name;
  std::vector<MetricColumn> columns = {{&metric, std::string(name), std::string(metric.unit)}};
  if (!is_shadow) return columns;
  for (const std::string_view unit : metric.other_units) {
    columns.push_back({&metric, name_in_unit(metric, unit), std::string(unit), columns.size()});
  }
  return columns;
}

std::vector<MetricColumn> metric_columns(const RunParams& run, bool is_shadow, const Statistics& described) {
  std::vector<MetricColumn> columns;
  const auto is_there = [&](const MetricColumn& column) {
    return std::ranges::any_of(described, [&](const auto& each) { return each.name == column.name; }) ||
           std::ranges::any_of(columns, [&](const auto& each) { return each.name == column.name; });
  };
  std::string names = run.metrics;  // of metrics, or of their columns
  if (const std::size_t at = names.find(uncorrected_rmse); at != std::string::npos) {
    names.replace(at, uncorrected_rmse.size(), rmse_metric.name);
  }
  for (const Metric* metric : select_metrics(names, color_metrics())) {
    for (MetricColumn& column : columns_of(*metric, is_shadow)) {
      if (!is_there(column)) columns.push_back(std::move(column));
    }
  }
  return columns;
}

}  // namespace umbrameter
