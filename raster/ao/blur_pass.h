// The blur of ambient occlusion.
#pragma once

#include "raster/gbuffer/gbuffer_pass.h"
#include "raster/gl/context.h"
#include "techniques/ao/technique.h"

namespace umbrameter {

/// All passes along both axes; background stays 1.
gl::Texture blur(const gl::Context& context, const GpuGBuffer& gbuffer, gl::Texture ao, const AoParams& params);

}  // namespace umbrameter
