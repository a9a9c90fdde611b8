// The exact error at every bias of an axis, from the histogram of the biases at which taps flip.
#pragma once

#include <vector>

#include "compare/shadow_lookup.h"
#include "compare/visibility.h"
#include "core/shadow_taps.h"
#include "scenes/scene.h"

namespace umbrameter {

/// The bin of BiasHistogram that a tap with that flip falls into: how many biases leave it blocked; all of them where
/// the flip is not a number. bias_unit is bias_unit_of() at the tap's receiver.
std::size_t bin_of(const BiasAxes& axes, float flip, float bias_unit);

/// The sums at each constant bias of the axis, for one of its slope factors: what rendering each cell would count.
std::vector<VisibilitySums> sums_at_biases(const BiasHistogram& histogram, std::size_t slope);

/// The histogram itself, on the processor from a map in memory. The truth is binary; only counted pixels matter. The
/// axes are as BiasAxes asks; neither may be empty.
BiasHistogram count_bias_response(const Scene& scene, const MapLookup& lookup, const Image<float>& truth,
                                  const Image<Counting>& counting, const BiasAxes& axes);

}  // namespace umbrameter
