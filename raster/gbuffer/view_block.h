// The camera as shaders see it. Internal to raster.
#pragma once

#include "core/math.h"
#include "scenes/view.h"

namespace umbrameter {

/// As View in shaders/view.glsl, layout std140.
struct ViewBlock {
  dmat4 clip_from_world{1.0};
  dmat4 view_from_world{1.0};
  dvec4 eye{0.0};
  dvec4 ray_origin[3] = {};
  dvec4 ray_direction[3] = {};
  dvec4 axis{0.0};
  mat4 clip_from_view{1.0f};
  int size[2] = {};
  int is_orthographic = 0;
  int unused = 0;
};
static_assert(sizeof(ViewBlock) == 592);

ViewBlock make_view_block(const View& view);

}  // namespace umbrameter
