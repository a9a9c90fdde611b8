// The blur of ambient occlusion.
#pragma once

#include "raster/ao/ao_inputs.h"
#include "raster/gl/context.h"
#include "techniques/ao/technique.h"

namespace umbrameter {

/// All passes along both axes; background stays 1.
gl::Texture blur(const gl::Context& context, const AoInputs& inputs, gl::Texture ao, AoParams params);

}  // namespace umbrameter
