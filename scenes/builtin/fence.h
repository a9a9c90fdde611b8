// One fence panel, drawn twice from one list of bars: as an alpha mask and as geometry. Internal to scenes/builtin*.
#pragma once

#include <vector>

#include "scenes/builtin/shapes.h"

namespace umbrameter::builtin {

/// Texels from (x0, y0) up to and without (x1, y1); y counts upwards from the lower edge.
struct TexelRectangle {
  int x0, y0, x1, y1;
};

/// The bars, which cross one another.
std::vector<TexelRectangle> fence_pattern();

/// Alpha is 1 in the bars and 0 between them. Filtered, it reaches one half where texels meet, so that at a cutoff of
/// one half a bar ends exactly at its texels' edges, but for corners, which are rounded within half a texel.
Texture fence_mask();

/// The same bars without thickness in the plane z = 0, from the origin, 1/128 m a texel; its pieces do not overlap.
Sheet fence_geometry();

}  // namespace umbrameter::builtin
