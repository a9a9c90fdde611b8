// The shadow error at every bias of an axis in one pass: as a histogram, as the bias at which each pixel's tap flips,
// and the taps that ray tests must check.
#pragma once

#include <functional>
#include <span>

#include "raster/gl/context.h"
#include "raster/shadow/shadow_lookup.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/histogram.h"

namespace umbrameter {

/// Bins the taps that are wrong at some bias of the axes by the bias at which they flip. Every tap flips once, so the
/// histogram gives the error at every bias; rendering each cell gives the same counts. Ignores lookup.bias.constant and
/// lookup.bias.slope. The look-up must have a truth.
BiasHistogram draw_bias_response(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes);

/// Ignores lookup.bias.constant and lookup.bias.slope. The look-up must have a truth and one tap per pixel, and the
/// axes one slope-scaled bias. Assigns causes by the two-plane rule.
TapFlips draw_tap_flips(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes);

/// Receives the taps in batches, in no particular order.
using UnresolvedTapSink = std::function<void(std::span<const UnresolvedTap>)>;

/// Lists every tap that draw_bias_response() counts as false occlusion (of_lit) or as peter-panning (otherwise) at some
/// bias of the axes, once. If the axes hold only the biases of one configuration, these are the taps of that cause that
/// draw_visibility() counts. Ignores
/// lookup.bias.constant and lookup.bias.slope. The look-up must have a truth. Memory use does not grow with the number
/// of taps.
void list_unresolved_taps(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes, bool of_lit,
                          const UnresolvedTapSink& sink);

}  // namespace umbrameter
