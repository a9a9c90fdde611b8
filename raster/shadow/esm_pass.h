// Exponential shadow maps: the filtered map and the look-up into it.
#pragma once

#include "raster/shadow/filtered_map.h"
#include "raster/shadow/visibility_pass.h"

namespace umbrameter {

/// exp(c·z) of each texel, box-blurred along both axes.
FilteredMap filter(const gl::Context& context, const ShadowMap& map, const Esm& esm);

/// lookup.filtered must be the result of filter() for the same map and technique.
RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const Esm& esm);

}  // namespace umbrameter
