// Lists the taps whose sample lies on another surface by the two-plane rule, so that ray tests can check them.
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

/// Lists every tap that draw_bias_response() counts as false occlusion (of_lit) or as peter-panning (otherwise) at some
/// bias of the axes, once. If the axes hold only the biases of one configuration, these are the taps of that cause that
/// draw_visibility() counts. Ignores
/// lookup.bias.constant and lookup.bias.slope. The look-up must have a truth. Memory use does not grow with the number
/// of taps.
void list_unresolved_taps(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes, bool of_lit,
                          const UnresolvedTapSink& sink);

}  // namespace umbrameter
