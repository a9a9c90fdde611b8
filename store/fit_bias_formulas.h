// Fits formulas of the bias over the axes of a sweep besides biases.
#pragma once

#include "results/sweep_bias.h"

namespace umbrameter {

/// Whether a sweep that varies these axes besides biases may have a formula. The resolution alone has its law.
bool may_have_formula(const std::vector<Column>& others);

/// Fits the formulas to the curves, whose facts are known. An axis along which a fact changes belongs to the formula;
/// each combination of the values of the remaining axes has separate ones.
void add_formulas(BiasCurves& curves);

}  // namespace umbrameter
