// Lists unresolved taps on the CPU; tests compare the shaders' list with it.
#pragma once

#include <vector>

#include "tests/support/reference/bias_response.h"

namespace umbrameter {

/// Lists the unresolved taps of a map in memory. The arguments are those of count_bias_response().
std::vector<UnresolvedTap> find_unresolved_taps(const Scene& scene, const MapLookup& lookup, const Image<float>& truth,
                                                const Image<PixelExclusion>& exclusion, const BiasAxes& axes);

}  // namespace umbrameter
