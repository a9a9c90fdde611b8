// The taps that the two-plane rule calls false occlusion, listed for a judge.
#pragma once

#include <functional>
#include <span>

#include "raster/gl/context.h"
#include "raster/shadow/shadow_lookup.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/filter.h"
#include "techniques/shadow/histogram.h"

namespace umbrameter {

/// Takes some of the taps, whose order is not defined; called until all were given.
using UnresolvedTapSink = std::function<void(std::span<const UnresolvedTap>)>;

/// Every tap that draw_bias_response() counts as false occlusion at some bias of the axes, once. Of one configuration
/// the axes hold its own biases, and these are the taps that draw_visibility() counts. params.bias.constant and
/// params.bias.slope are not looked at. The look-up must have a truth. Memory stays bounded however many there are.
void list_unresolved_taps(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes,
                          const UnresolvedTapSink& sink);

}  // namespace umbrameter
