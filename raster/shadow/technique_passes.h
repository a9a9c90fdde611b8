// The passes of every shadow technique: filter() computes its filtered map, draw() its visibility.
#pragma once

#include "raster/shadow/filtered_map.h"
#include "raster/shadow/prefiltered_pass.h"
#include "raster/shadow/screen_space_pass.h"
#include "raster/shadow/visibility_pass.h"

namespace umbrameter {

FilteredMap filter(const DrawnMap& drawn, const Pcf& pcf);
RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const Pcf& pcf);

}  // namespace umbrameter
