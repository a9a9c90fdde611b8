// A complete sweep, the input of reports.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/bias_facts.h"
#include "compare/bias_plateau.h"
#include "experiments/results_store.h"
#include "experiments/sweep_evaluator.h"
#include "experiments/sweep_plan.h"

namespace umbrameter {

struct SweepResults {
  const Parameters& parameters;
  const SweepPlan& plan;
  const ResultsStore& store;
  const CellStatistics& statistics;  ///< the kind of statistics in the rows
  /// mean_depth_unit() at these values of the axes, metres; empty for ambient occlusion.
  std::function<double(const std::vector<Value>& values)> depth_unit;
  /// measure_bias_facts() at these values of the axes; empty for ambient occlusion.
  std::function<BiasFacts(const std::vector<Value>& values)> bias_facts;
  /// Distance limit of an ambient-occlusion reference: "up to 58.6 cm"; empty if it is varied.
  std::string ao_limit{};
  std::vector<MetricColumn> metrics{};  ///< the image metrics in the rows
  /// measure_bias_evidence() at these values of the axes; empty if the scene has a floor or is not at hand.
  std::function<BiasEvidence(const std::vector<Value>& values)> bias_evidence{};

  SweptQuantity quantity() const { return quantity_of(statistics); }
  bool is_by_cause() const { return std::holds_alternative<VisibilityStatistics>(statistics); }
};

}  // namespace umbrameter
