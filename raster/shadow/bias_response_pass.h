// The shadow error at every bias of an axis, from one pass.
#pragma once

#include "raster/gl/context.h"
#include "raster/shadow/shadow_lookup.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/filter.h"
#include "techniques/shadow/histogram.h"

namespace umbrameter {

/// Counts the taps that are wrong at some bias of the axes by where they flip: every tap flips once, so that the
/// histogram holds the error at all of them. params.bias.constant and params.bias.slope are not read; all else is.
/// The look-up must have a truth. Rendering each cell gives the same counts.
BiasHistogram draw_bias_response(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes);

}  // namespace umbrameter
