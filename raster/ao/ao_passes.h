// What every AO technique reads, and the passes around and of the techniques. Internal to raster/ao.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "raster/gbuffer/gbuffer_pass.h"
#include "raster/gl/pass.h"
#include "scenes/view.h"
#include "techniques/ao/technique.h"

namespace umbrameter {

struct AoInputs {
  const GpuGBuffer& gbuffer;
  const gl::Texture& normals;       ///< geometric normals: those of the G-buffer, or draw_normals()
  const gl::Texture& linear_depth;  ///< R32F: depth along the camera's axis, infinite on background
  const View& view;
  std::uint32_t seed = 1;
  AoResolution resolution = AoResolution::full;
};

/// Of the image that technique and blur compute, pixels.
ivec2 ao_image_size(const AoInputs& inputs);

/// R32F, of that size.
gl::Texture make_ao_image(const char* label, const AoInputs& inputs);

/// Binds ids, position_depth, geometric_normal and linear_depth.
gl::Pass& bind(gl::Pass& pass, const AoInputs& inputs);

/// For shaders that include ao_resolution.glsl.
std::string resolution_defines(AoResolution resolution);

/// Unit geometric normals in world space, 0 on background, RGBA32F; the last component is unused. rgb8: rounded to 8
/// bits for each component. depth: perpendicular to the steps to two neighbours in the depth buffer, on each axis the
/// one whose depth is closer (J. Turánszki, Improved normal reconstruction from depth, 2019).
gl::Texture draw_normals(const gl::Context& context, const GpuGBuffer& gbuffer, const gl::Texture& linear_depth,
                         const View& view, AoInputParams params);

/// Accessibility before the blur, 1 on background, R32F. Of SSAO too (ssao_pass.h).
gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const AoTechnique& technique);

/// The mean open direction by the technique: unit, world space; 0 on background and if no direction is open. RGBA32F.
/// Nothing if the technique computes none.
std::optional<gl::Texture> draw_bent_normals(const gl::Context& context, const AoInputs& inputs,
                                             const AoTechnique& technique);

/// All passes along both axes; background stays 1.
gl::Texture blur(const gl::Context& context, const AoInputs& inputs, gl::Texture ao, AoParams params);

/// Joint bilateral upsampling on depth and normal; background is 1. A pixel whose surfel `ao` holds keeps its value.
gl::Texture upsample(const gl::Context& context, const AoInputs& inputs, const gl::Texture& ao, const AoParams& params);

}  // namespace umbrameter
