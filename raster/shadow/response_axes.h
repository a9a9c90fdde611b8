// The biases of an axis as shaders/response.glsl reads them. Internal to raster.
#pragma once

#include "raster/gl/objects.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/filter.h"
#include "techniques/shadow/histogram.h"

namespace umbrameter {

struct ResponseAxes {
  gl::Buffer block;
  gl::Buffer values;
};

/// Bound while it lives. Neither axis is empty.
[[nodiscard]] ResponseAxes bind_axes(const BiasAxes& axes);

}  // namespace umbrameter
