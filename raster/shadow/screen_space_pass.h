// Screen-space shadows (techniques/shadow/screen_space.h), alone and combined with a technique that reads a map.
#pragma once

#include "raster/shadow/filtered_map.h"
#include "raster/shadow/visibility_pass.h"

namespace umbrameter {

FilteredMap filter(const DrawnMap& drawn, const ScreenSpace& technique);
/// lookup.view must be the view that the surfels belong to.
RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const ScreenSpace& technique);

FilteredMap filter(const DrawnMap& drawn, const ContactShadows& technique);
/// The smaller of both visibilities. Since that of the march is 0 or 1, it is their product too.
RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const ContactShadows& technique);

}  // namespace umbrameter
