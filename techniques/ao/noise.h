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

/// Pairs of numbers from 0 to 1 in x and y; z and w 0. Each of the tile's n pixels has another n-th of the range in x,
/// and another in y, so that the mean over the tile covers both evenly. Depends only on the arguments.
std::vector<vec4> stratified_tile(const AoNoiseParams& params, std::uint32_t seed);

}  // namespace umbrameter
