// The buffers of BiasAxes that shaders/response.glsl reads. Internal to raster.
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

/// Uploads and binds the axes; they stay bound while the result lives. Neither axis may be empty.
[[nodiscard]] ResponseAxes bind_axes(const BiasAxes& axes);

}  // namespace umbrameter
