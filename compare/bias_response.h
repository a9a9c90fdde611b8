// Computes the exact error at every bias of an axis from the histogram of the biases at which taps flip.
#pragma once

#include <vector>

#include "compare/visibility.h"
#include "techniques/shadow/histogram.h"

namespace umbrameter {

/// The sums at each constant bias of the axes, for the slope factor with index `slope`. Rendering each cell gives the
/// same sums.
std::vector<VisibilitySums> sums_at_biases(const BiasHistogram& histogram, std::size_t slope);

/// The same as statistics.
std::vector<VisibilityStatistics> statistics_at_biases(const BiasHistogram& histogram, std::size_t slope,
                                                       const TruthCounts& truth);

}  // namespace umbrameter
