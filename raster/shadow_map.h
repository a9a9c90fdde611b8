// A light's shadow map: linear depth and the triangle that each texel's centre sees.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/shadow_taps.h"
#include "raster/gl/context.h"
#include "raster/gl/objects.h"
#include "raster/parameters.h"
#include "raster/uploaded_scene.h"
#include "scenes/light_frame.h"

namespace umbrameter {

/// Depths and ids in textures with one layer, six for a cube; bottom row (v = 0) first.
struct ShadowMap {
  LightFrame frame;
  gl::Texture depth;  ///< depth 32F: metres / frame.far_depth; 1 where the light meets nothing
  gl::Texture ids;    ///< RG32UI: instance, triangle; no_id where the light meets nothing
};

/// Every face of every triangle, masked materials by their alpha. frame.resolution decides the size.
/// Throws Error (usage) naming shadow.resolution when the device or the memory is too small for it.
ShadowMap draw_shadow_map(const gl::Context& context, const UploadedScene& scene, const Light& light,
                          const LightFrame& frame, const ShadowParams& params);

ShadowMapImages read_back(const gl::Context& context, const ShadowMap& map);

/// Of each face, metres, as depth_of(); infinity where the light meets nothing.
std::vector<Image<float>> to_metres(const ShadowMapImages& images, const LightFrame& frame);

/// Unit direction, light space, from the light through the centre of a texel of a cube map's face; column x, row y
/// from the top, as in ShadowMapImages.
dvec3 cube_direction(const LightFrame& frame, int face, int x, int y);

}  // namespace umbrameter
