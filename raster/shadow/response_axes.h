// Biases at which shaders measure the error, shaders/response.glsl, and the pixels that are wrong at some of them.
// Internal to raster.
#pragma once

#include "raster/gl/pass.h"
#include "raster/shadow/shadow_lookup.h"
#include "techniques/shadow/histogram.h"

namespace umbrameter {

/// Uploads and binds the axes, neither of which may be empty.
gl::Pass& bind_axes(gl::Pass& pass, const BiasAxes& axes);

/// Lists the pixels that have a wrong tap at some bias of the axes; lit_alone: only those that are lit in the truth.
gl::Buffer list_response_pixels(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes,
                                bool lit_alone);

}  // namespace umbrameter
