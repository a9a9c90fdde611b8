// Measures the shadow error at every bias of an axis in one pass.
#pragma once

#include "raster/gl/context.h"
#include "raster/shadow/shadow_lookup.h"
#include "techniques/shadow/histogram.h"

namespace umbrameter {

/// Bins the taps that are wrong at some bias of the axes by the bias at which they flip. Every tap flips once, so the
/// histogram gives the error at every bias; rendering each cell gives the same counts. Ignores lookup.bias.constant and
/// lookup.bias.slope. The look-up must have a truth.
BiasHistogram draw_bias_response(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes);

}  // namespace umbrameter
