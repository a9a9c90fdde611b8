// The methods whose text shaders and processor share (techniques/ao/*.glsl).
#pragma once

#include "raster/ao/ao_inputs.h"
#include "raster/gl/context.h"
#include "techniques/ao/technique.h"

namespace umbrameter {

gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Gtao& technique);
gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Hbao& technique);
gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Alchemy& technique);
gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Crytek& technique);
gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Bitmask& technique);
gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Marched& technique);

/// The mean open direction by the technique: unit, world space; 0 on background and if no direction is open. RGBA32F.
gl::Texture draw_bent_normals(const gl::Context& context, const AoInputs& inputs, const Gtao& technique);
gl::Texture draw_bent_normals(const gl::Context& context, const AoInputs& inputs, const Bitmask& technique);

}  // namespace umbrameter
