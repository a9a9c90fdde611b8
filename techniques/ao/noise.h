// The tile of random rotations, repeated over the image, that rotates a technique's kernel at each pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math.h"
#include "core/parameters.h"

namespace umbrameter {

struct AoNoiseParams {
  int size = 4;
};
Parameters describe(AoNoiseParams& params);

/// Rotation vectors perpendicular to +z: x and y in [−1, 1], z and w 0; row by row from the top left. Depends only on
/// the arguments.
std::vector<vec4> rotation_tile(const AoNoiseParams& params, std::uint32_t seed);

}  // namespace umbrameter
