// The techniques whose text shaders and processor share (techniques/ao/*.glsl): all but SSAO.
#pragma once

#include <optional>

#include "raster/ao/ao_inputs.h"
#include "raster/gl/context.h"
#include "techniques/ao/technique.h"

namespace umbrameter {

/// Accessibility before the blur, 1 on background, R32F. Of SSAO too (ssao_pass.h).
gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const AoTechnique& technique);

/// The mean open direction by the technique: unit, world space; 0 on background and if no direction is open. RGBA32F.
/// Nothing if the technique computes none.
std::optional<gl::Texture> draw_bent_normals(const gl::Context& context, const AoInputs& inputs,
                                             const AoTechnique& technique);

}  // namespace umbrameter
