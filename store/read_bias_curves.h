// Reads recommended biases and fits from the rows of a sweep.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "compare/bias_facts.h"
#include "results/sweep_bias.h"
#include "store/sweep_results.h"

namespace umbrameter {

/// What the bias depends on besides the rows, at one combination of the axes other than biases.
struct BiasContext {
  double depth_unit = 0.0;                 ///< mean_depth_unit()
  bool texels_differ = false;              ///< as in BiasAdvice
  BiasFacts facts{};                       ///< measure_bias_facts()
  std::optional<BiasEvidence> evidence{};  ///< measure_bias_evidence(); nothing: what the rows say
};
/// Measures it at these values of the axes; `facts` only if they are needed.
using MeasureBiasContext = std::function<BiasContext(const std::vector<Value>& values, bool with_facts)>;

/// Empty if no bias is varied, the sweep does not measure causes, or there are more than 4,096 slope-scaled biases.
/// Without `measure`, depths are not converted and there are no formulas.
std::optional<BiasCurves> read_bias_curves(const SweepResults& sweep, const MeasureBiasContext& measure = {});

/// The curve of a cell with these values of the plan's axes; nullptr if it was not read.
const BiasCurve* curve_of_cell(const BiasCurves& curves, const SweepPlan& plan, const std::vector<Value>& values);

}  // namespace umbrameter
