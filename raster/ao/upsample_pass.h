// From half to full resolution.
#pragma once

#include "raster/ao/ao_inputs.h"
#include "raster/gl/context.h"
#include "techniques/ao/technique.h"

namespace umbrameter {

/// Joint bilateral upsampling on depth and normal; background is 1. A pixel whose surfel `ao` holds keeps its value.
gl::Texture upsample(const gl::Context& context, const AoInputs& inputs, const gl::Texture& ao, const AoParams& params);

}  // namespace umbrameter
