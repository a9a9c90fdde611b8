// Hemisphere SSAO.
#pragma once

#include <functional>

#include "raster/ao/ao_passes.h"
#include "raster/gl/context.h"
#include "techniques/ao/bias_response.h"
#include "techniques/ao/ssao.h"

namespace umbrameter {

/// A uniform hemisphere of points about the geometric normal (the reference's hemisphere; a shading normal would add
/// its own error).
gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Ssao& ssao);

/// Receives the rows of the image from the top on, several at a time; valid during the call.
using AoResponseSink = std::function<void(std::span<const AoResponseRow>)>;

/// The samples that occlude at the axis's first bias or more, `axes.samples.back()` of each pixel. The axes replace the
/// technique's bias and number of samples.
void list_occluding_samples(const gl::Context& context, const AoInputs& inputs, Ssao ssao, const AoAxes& axes,
                            const AoResponseSink& sink);

}  // namespace umbrameter
