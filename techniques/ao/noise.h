// The tile of random rotations, repeated over the image, that turns a technique's kernel from pixel to pixel.
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

/// Rotation vectors across +z in [−1, 1]², row by row from the top left; z and w are 0. A function of the seed.
std::vector<vec4> rotation_tile(const AoNoiseParams& params, std::uint32_t seed);

}  // namespace umbrameter
