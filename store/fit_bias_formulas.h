// Fits formulas of the bias over the axes of a sweep besides biases.
#pragma once

#include "results/sweep_bias.h"

namespace umbrameter {

/// Fits the formulas to the curves, whose facts are known. An axis along which a fact changes belongs to the formula;
/// each combination of the values of the remaining axes has separate ones. None without an axis of the formula.
void add_formulas(BiasCurves& curves);

}  // namespace umbrameter
