// Unresolved taps listed on the CPU: the reference for the shaders' list.
#pragma once

#include <vector>

#include "techniques/shadow/reference/bias_response.h"

namespace umbrameter {

/// The list on the processor, from a map in memory, as count_bias_response() counts.
std::vector<ForeignTap> find_foreign_taps(const Scene& scene, const MapLookup& lookup, const Image<float>& truth,
                                          const Image<Counting>& counting, const BiasAxes& axes);

}  // namespace umbrameter
