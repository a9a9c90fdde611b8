// What an AO technique reads instead of the exact surfels: normals as a compact G-buffer has them.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

enum class AoNormals : int { exact, rgb8, depth };

struct AoInputParams {
  AoNormals normals = AoNormals::exact;
};
Parameters describe(AoInputParams& params);

}  // namespace umbrameter
