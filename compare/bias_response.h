// The exact error at every bias of an axis, from the histogram of the biases at which taps flip.
#pragma once

#include <vector>

#include "compare/visibility.h"
#include "techniques/shadow/histogram.h"

namespace umbrameter {

/// The sums at each constant bias of the axis, for one of its slope factors: what rendering each cell would count.
std::vector<VisibilitySums> sums_at_biases(const BiasHistogram& histogram, std::size_t slope);

}  // namespace umbrameter
