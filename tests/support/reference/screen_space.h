// The march of screen-space shadows on the CPU.
#pragma once

#include "core/gbuffer.h"
#include "scenes/light.h"
#include "scenes/view.h"
#include "techniques/shadow/screen_space.h"

namespace umbrameter {

/// Visibility of each surfel: 1 lit, 0 blocked; back-facing: 0; background: 1. Apart from rounding, the same as
/// draw() of raster/shadow/technique_passes.h. `depth` is that of each pixel along the camera's axis, as in GBuffer.
Image<float> march_depth_buffer(const GBuffer& gbuffer, const View& view, const Light& light,
                                const ScreenSpace& technique);

}  // namespace umbrameter
