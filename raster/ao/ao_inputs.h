// What every AO technique reads. Internal to raster/ao.
#pragma once

#include <cstdint>
#include <string>

#include "raster/gbuffer/gbuffer_pass.h"
#include "raster/gl/pass.h"
#include "scenes/view.h"
#include "techniques/ao/resolution.h"

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

}  // namespace umbrameter
