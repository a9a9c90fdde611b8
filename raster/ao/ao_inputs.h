// What every AO technique reads. Internal to raster/ao.
#pragma once

#include <cstdint>

#include "raster/gbuffer/gbuffer_pass.h"
#include "scenes/view.h"

namespace umbrameter {

struct AoInputs {
  const GpuGBuffer& gbuffer;
  const gl::Texture& linear_depth;  ///< R32F: depth along the camera's axis, infinite on background
  const View& view;
  std::uint32_t seed = 1;
};

}  // namespace umbrameter
