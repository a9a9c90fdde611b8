// Looks up the shadow map at every surfel and classifies each wrong tap by cause.
#pragma once

#include "core/image.h"
#include "raster/gl/context.h"
#include "raster/shadow/shadow_lookup.h"
#include "techniques/shadow/causes.h"

namespace umbrameter {

/// Visibility and wrong taps of each surfel.
RasterVisibility draw_visibility(const gl::Context& context, const ShadowLookup& lookup);

}  // namespace umbrameter
