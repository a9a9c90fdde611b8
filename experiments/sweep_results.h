// A complete sweep, as those who tell of it are given it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/results_store.h"
#include "experiments/sweep_evaluator.h"
#include "experiments/sweep_plan.h"

namespace umbrameter {

struct SweepResults {
  const Parameters& parameters;
  const SweepPlan& plan;
  const ResultsStore& store;
  const CellStatistics& statistics;  ///< of the kind that the rows hold
  /// The depth that the shadow map's 1 stands for at these values of the axes, metres; none for ambient occlusion.
  std::function<double(const std::vector<Value>& values)> depth_range;
  /// Of ambient occlusion, how far the reference looks: "up to 58.6 cm"; empty where that is varied.
  std::string ao_limit{};

  bool is_ao() const { return std::holds_alternative<AoStatistics>(statistics); }
  bool is_by_cause() const { return std::holds_alternative<VisibilityStatistics>(statistics); }
};

}  // namespace umbrameter
