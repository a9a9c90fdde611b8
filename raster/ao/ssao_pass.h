// Screen-space ambient occlusion.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/math.h"
#include "raster/gbuffer/gbuffer_pass.h"
#include "raster/gl/context.h"
#include "scenes/view.h"
#include "techniques/ao/parameters.h"

namespace umbrameter {

/// Screen-space ambient occlusion: accessibility, 1 open and on background, after its blur. A uniform hemisphere of
/// points about the geometric normal (the reference's hemisphere; a shading normal would add its own error). Lengths of
/// the params are in metres: in_metres().
Image<float> draw_ao(const gl::Context& context, const GpuGBuffer& gbuffer, const View& view, const AoParams& params,
                     std::uint32_t seed);

/// The kernel: points in the unit hemisphere about +z, uniform in direction, nearer together towards the centre by
/// the accelerating factor lerp(0.1, 1, (i/n)²) (Learn OpenGL, "SSAO"). w is 0. A function of the seed.
std::vector<vec4> ao_kernel(int samples, std::uint32_t seed);

/// Rotation vectors across +z in [−1, 1]², noise_size² of them; z and w are 0. A function of the seed.
std::vector<vec4> ao_rotations(int noise_size, std::uint32_t seed);

}  // namespace umbrameter
