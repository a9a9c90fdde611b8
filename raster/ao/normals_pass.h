// The normals that AO techniques read, if they are not the exact ones.
#pragma once

#include "raster/gbuffer/gbuffer_pass.h"
#include "raster/gl/context.h"
#include "scenes/view.h"
#include "techniques/ao/inputs.h"

namespace umbrameter {

/// Unit geometric normals in world space, 0 on background, RGBA32F; the last component is unused. rgb8: rounded to 8
/// bits for each component. depth: perpendicular to the steps to two neighbours in the depth buffer, on each axis the
/// one whose depth is closer (J. Turánszki, Improved normal reconstruction from depth, 2019).
gl::Texture draw_normals(const gl::Context& context, const GpuGBuffer& gbuffer, const gl::Texture& linear_depth,
                         const View& view, AoInputParams params);

}  // namespace umbrameter
