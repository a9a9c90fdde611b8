// Finds, for each pixel of a look-up with one tap, the bias at which the tap flips. For images at any bias of an axis.
#pragma once

#include "raster/gl/context.h"
#include "raster/shadow/shadow_lookup.h"
#include "techniques/shadow/histogram.h"

namespace umbrameter {

/// Ignores lookup.bias.constant and lookup.bias.slope. The look-up must have a truth and one tap per pixel, and the
/// axes one slope-scaled bias. Assigns causes by the two-plane rule.
TapFlips draw_tap_flips(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes);

}  // namespace umbrameter
