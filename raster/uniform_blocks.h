// The uniform blocks of the shaders as structs: C++ lays these members out as std140 does. Internal to raster.
#pragma once

#include "core/math.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {
namespace shared {

#define MAX_MAP_VIEWS max_map_views
#define layout(packing)
#define uniform struct
#include "raster/shaders/light.glsl"
#include "raster/shaders/view.glsl"
#undef uniform
#undef layout
#undef MAX_MAP_VIEWS

}  // namespace shared

using shared::LightBlock;
using ViewBlock = shared::View;
static_assert(sizeof(LightBlock) == 1296 && sizeof(ViewBlock) == 592);

}  // namespace umbrameter
