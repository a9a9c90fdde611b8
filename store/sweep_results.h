// A complete sweep, the input of reports.
#pragma once

#include <string>
#include <vector>

#include "experiments/settings/sweep_plan.h"
#include "results/swept.h"
#include "store/results_store.h"

namespace umbrameter {

struct SweepResults {
  const Parameters& parameters;
  const SweepPlan& plan;
  const ResultsStore& store;
  const CellStatistics& statistics;  ///< the kind of statistics in the rows
  /// Distance limit of an ambient-occlusion reference: "up to 58.6 cm"; empty if it is varied.
  std::string ao_limit{};
  std::vector<MetricColumn> metrics{};  ///< the image metrics in the rows

  SweptQuantity quantity() const { return quantity_of(statistics); }
  bool is_by_cause() const { return std::holds_alternative<VisibilityStatistics>(statistics); }
};

/// The row of least error.
inline std::vector<Value> least_row(const SweepResults& sweep) {
  return sweep.store.least(std::string(error_statistic), {}, 1).rows.front();
}

}  // namespace umbrameter
