// Sample kernels of the AO techniques: the points relative to a surfel at which a technique looks for occluders.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math.h"

namespace umbrameter {

/// Points in the unit hemisphere around +z, uniform in direction. The factor lerp(0.1, 1, (i/n)²) on the distance of
/// point i makes them denser near the centre (J. de Vries, Learn OpenGL, "SSAO"). w is 0. Depends only on the
/// arguments.
std::vector<vec4> hemisphere_kernel(int samples, std::uint32_t seed);

}  // namespace umbrameter
