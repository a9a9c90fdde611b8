// The columns of the image metrics that run.metrics names.
#pragma once

#include <string>
#include <vector>

#include "compare/metrics/color_metric.h"
#include "core/statistics.h"
#include "experiments/settings/experiment.h"

namespace umbrameter {

/// A metric in its own unit or in another one.
struct MetricColumn {
  const Metric* metric = nullptr;
  std::string name;  ///< "edge-roughness", "edge-roughness-texels"
  std::string unit;
  std::size_t other_unit = 0;  ///< 0: its own; else 1 + index into Metric::other_units

  std::string meaning() const;  ///< with the direction: "...; 0 is equal"
};

struct MetricScore {
  MetricColumn column;
  double score = 0.0;
};

/// The columns of a metric: one for each unit, the other units only of shadows, whose light and map are known.
std::vector<MetricColumn> columns_of(const Metric& metric, bool is_shadow);

/// The columns of the metrics that run.metrics names, each once and without those that `described` has, such as mae.
/// Throws Error (usage) for an unknown name.
std::vector<MetricColumn> metric_columns(const RunParams& run, bool is_shadow, const Statistics& described = {});

}  // namespace umbrameter
