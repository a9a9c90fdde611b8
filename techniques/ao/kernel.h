// Sample kernels of the AO techniques: the points relative to a surfel at which a technique looks for occluders.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math.h"

namespace umbrameter {

/// Points in the unit hemisphere about +z, uniform in direction, nearer together towards the centre by the accelerating
/// factor lerp(0.1, 1, (i/n)²) (J. de Vries, Learn OpenGL, "SSAO"). w is 0. A function of the seed.
std::vector<vec4> hemisphere_kernel(int samples, std::uint32_t seed);

}  // namespace umbrameter
