// Hemisphere SSAO.
#pragma once

#include "raster/ao/ao_inputs.h"
#include "raster/gl/context.h"
#include "techniques/ao/ssao.h"

namespace umbrameter {

/// A uniform hemisphere of points about the geometric normal (the reference's hemisphere; a shading normal would add
/// its own error).
gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Ssao& ssao);

}  // namespace umbrameter
