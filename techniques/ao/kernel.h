// Sample kernels of the AO techniques: the points relative to a surfel at which a technique looks for occluders.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math.h"
#include "core/parameters.h"

namespace umbrameter {

enum class AoKernel : int { learnopengl, progressive };

struct AoKernelParams {
  AoKernel kind = AoKernel::learnopengl;
};
Parameters describe(AoKernelParams& params);

/// Points in the unit hemisphere around +z, uniform in direction, denser near the centre; w is 0. Depends only on the
/// arguments. learnopengl: random points, with the factor lerp(0.1, 1, (i/n)²) on the distance of point i (J. de Vries,
/// Learn OpenGL, "SSAO"). progressive: the same distribution from a low-discrepancy sequence with a random start; fewer
/// samples are the first ones of more samples.
std::vector<vec4> hemisphere_kernel(const AoKernelParams& params, int samples, std::uint32_t seed);

}  // namespace umbrameter
