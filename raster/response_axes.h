// The biases of an axis as shaders/response.glsl reads them. Internal to raster.
#pragma once

#include "core/shadow_taps.h"
#include "raster/gl/objects.h"

namespace umbrameter {

struct ResponseAxes {
  gl::Buffer block;
  gl::Buffer values;
};

/// Bound while it lives. Neither axis is empty.
[[nodiscard]] ResponseAxes bind_axes(const BiasAxes& axes);

}  // namespace umbrameter
