// The histogram of critical biases on the CPU; tests compare the shaders' histogram with it.
#pragma once

#include "scenes/scene.h"
#include "techniques/shadow/histogram.h"
#include "tests/support/reference/taps.h"

namespace umbrameter {

/// The histogram for a map in memory, over the counted pixels. The truth is binary. Neither axis may be empty.
BiasHistogram count_bias_response(const Scene& scene, const MapLookup& lookup, const Image<float>& truth,
                                  const Image<PixelExclusion>& exclusion, const BiasAxes& axes);

}  // namespace umbrameter
