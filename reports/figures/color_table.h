// The colour maps of all pictures and of the page's viewer.
#pragma once

#include <array>

#include "reports/figures/figures.h"

namespace umbrameter {

inline constexpr int color_table_size = 1025;  // odd, so that the middle of a diverging scale has an entry of its own
using ColorTable = std::array<glm::u8vec3, color_table_size>;

/// sRGB bytes at equal steps from the lower to the upper end of the scale.
ColorTable color_table(ColorMap map);

}  // namespace umbrameter
