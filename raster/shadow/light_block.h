// The uniform block of a light and its map. Internal to raster.
#pragma once

#include <string>

#include "raster/uniform_blocks.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// The block for drawing the map. Bias and filter are 0; lookup_pass() in shadow_lookup.h sets them for a look-up.
LightBlock make_light_block(const Light& light, const MapLayout& layout);

/// "#define MAP_KIND 0", MAP_WARPED, ROUNDS_RECEIVERS, and STORES_OVER_W of a warped map
std::string map_defines(const MapLayout& layout);

}  // namespace umbrameter
