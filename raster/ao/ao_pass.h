// Screen-space ambient occlusion.
#pragma once

#include <cstdint>
#include <optional>

#include "core/image.h"
#include "raster/ao/ssao_pass.h"
#include "raster/gbuffer/gbuffer_pass.h"
#include "raster/gl/context.h"
#include "scenes/view.h"
#include "techniques/ao/technique.h"

namespace umbrameter {

/// Accessibility by the selected technique, 1 open and on background, after its blur, upsampling and tone. Lengths of
/// the params are in metres: in_metres().
Image<float> draw_ao(const gl::Context& context, const GpuGBuffer& gbuffer, const View& view, const AoParams& params,
                     std::uint32_t seed);

/// The mean open direction of each surfel by the technique: unit, world space; 0 on background and if no direction is
/// open. At full resolution, without blur. Nothing if the technique yields none.
std::optional<Image<vec3>> draw_bent_normals(const gl::Context& context, const GpuGBuffer& gbuffer, const View& view,
                                             const AoParams& params, std::uint32_t seed);

/// What every technique reads of the surfels.
struct AoSurfelImages {
  Image<float> depth;   ///< along the camera's axis, metres; infinite on background
  Image<vec3> normals;  ///< unit, world space: those that params.inputs selects; 0 on background
};
AoSurfelImages read_ao_surfels(const gl::Context& context, const GpuGBuffer& gbuffer, const View& view,
                               const AoParams& params);

/// Calls the sink with the samples of hemisphere SSAO that occlude at the axes' first bias or more (ssao_pass.h). The
/// technique must be one whose samples flip at the bias.
void draw_ao_response(const gl::Context& context, const GpuGBuffer& gbuffer, const View& view, const AoParams& params,
                      std::uint32_t seed, const AoAxes& axes, const AoResponseSink& sink);

}  // namespace umbrameter
