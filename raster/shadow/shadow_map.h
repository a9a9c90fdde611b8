// A light's shadow map: linear depth and the triangle that each texel's centre sees.
#pragma once

#include "raster/gbuffer/uploaded_scene.h"
#include "raster/gl/context.h"
#include "raster/gl/objects.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/filter.h"
#include "techniques/shadow/histogram.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// Depths and ids in textures with one layer, six for a cube; bottom row (v = 0) first.
struct ShadowMap {
  MapLayout frame;
  gl::Texture depth;  ///< depth 32F: metres / frame.far_depth; 1 where the light meets nothing
  gl::Texture ids;    ///< RG32UI: instance, triangle; no_id where the light meets nothing
};

/// The textures of a map of this frame, with nothing drawn into them. frame.resolution decides their size.
/// Throws Error (usage) naming shadow.map.resolution when the device or the memory is too small for it.
ShadowMap make_shadow_map(const gl::Context& context, const MapLayout& frame);

/// Whether the map's textures have the size and the number of layers that this frame needs.
bool has_textures_for(const ShadowMap& map, const MapLayout& frame);

/// Draws map.frame into the map's textures, whatever they hold. See draw_shadow_map().
void redraw_shadow_map(const gl::Context& context, const UploadedScene& scene, const Light& light, ShadowMap& map);

/// Every face of every triangle, masked materials by their alpha. Throws what make_shadow_map() throws.
ShadowMap draw_shadow_map(const gl::Context& context, const UploadedScene& scene, const Light& light,
                          const MapLayout& frame);

ShadowMapImages read_back(const gl::Context& context, const ShadowMap& map);

}  // namespace umbrameter
