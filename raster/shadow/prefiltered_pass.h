// Prefiltered shadow maps (techniques/shadow/prefiltered.h): the filtered map and the look-up into it.
#pragma once

#include "raster/shadow/filtered_map.h"
#include "raster/shadow/visibility_pass.h"

namespace umbrameter {

/// The values of each texel, blurred along both axes.
FilteredMap filter(const gl::Context& context, const ShadowMap& map, const Prefiltered& technique);

/// lookup.filtered must be the result of filter() for the same map and technique; with mipmaps, lookup.view that of the
/// surfels.
RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const Prefiltered& technique);

}  // namespace umbrameter
