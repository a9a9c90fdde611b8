// The camera as shaders see it. Internal to raster.
#pragma once

#include "raster/uniform_blocks.h"
#include "scenes/view.h"

namespace umbrameter {

ViewBlock make_view_block(const View& view);

}  // namespace umbrameter
