// The figures of a sweep over the constant bias: causes and error against it, error over both biases, and the front of
// acne against peter-panning.
#pragma once

#include "present/bias_report.h"
#include "store/sweep_results.h"

namespace umbrameter {

/// Adds at most `most` figures, those of the first combinations of the axes that no figure shows.
void add_bias_figures(Presentation& presentation, const SweepResults& sweep, const BiasCurves& curves,
                      std::size_t most);

}  // namespace umbrameter
