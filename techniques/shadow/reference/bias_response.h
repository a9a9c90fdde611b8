// The histogram of critical biases counted on the CPU: the reference for the shaders' histogram.
#pragma once

#include "scenes/scene.h"
#include "techniques/shadow/histogram.h"
#include "techniques/shadow/reference/lookup.h"

namespace umbrameter {

/// The histogram, from a map in memory. The truth is binary; only counted pixels matter. The
/// axes are as BiasAxes asks; neither may be empty.
BiasHistogram count_bias_response(const Scene& scene, const MapLookup& lookup, const Image<float>& truth,
                                  const Image<PixelExclusion>& counting, const BiasAxes& axes);

}  // namespace umbrameter
