// Lists the taps that are false occlusion by the two-plane rule, so that ray tests can confirm or reclassify them.
#pragma once

#include <functional>
#include <span>

#include "raster/gl/context.h"
#include "raster/shadow/shadow_lookup.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/histogram.h"

namespace umbrameter {

/// Receives the taps in batches, in no particular order.
using UnresolvedTapSink = std::function<void(std::span<const UnresolvedTap>)>;

/// Lists every tap that draw_bias_response() counts as false occlusion at some bias of the axes, once. If the axes hold
/// only the biases of one configuration, these are the false-occlusion taps that draw_visibility() counts. Ignores
/// lookup.bias.constant and lookup.bias.slope. The look-up must have a truth. Memory use does not grow with the number
/// of taps.
void list_unresolved_taps(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes,
                          const UnresolvedTapSink& sink);

}  // namespace umbrameter
