// Unresolved taps listed on the CPU: the reference for the shaders' list.
#pragma once

#include <vector>

#include "techniques/shadow/reference/bias_response.h"

namespace umbrameter {

/// The list on the processor, from a map in memory, as count_bias_response() counts.
std::vector<UnresolvedTap> find_unresolved_taps(const Scene& scene, const MapLookup& lookup, const Image<float>& truth,
                                                const Image<PixelExclusion>& counting, const BiasAxes& axes);

}  // namespace umbrameter
