// A light's shadow map: linear depth and triangle ids, sampled at texel centres.
#pragma once

#include <optional>

#include "raster/gbuffer/uploaded_scene.h"
#include "raster/gl/context.h"
#include "raster/gl/objects.h"
#include "techniques/shadow/map_depth.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// Depths and ids in array textures with one layer per view; bottom row (v = 0) first.
struct ShadowMap {
  MapLayout layout;
  gl::Texture depth;  ///< depth 32F: metres / layout.far_depth; 1 where the light hits nothing
  gl::Texture ids;    ///< RG32UI: instance, triangle; no_id where the light hits nothing
};

/// Allocates the textures of a map with this layout and draws nothing.
/// Throws Error (usage) naming shadow.map.resolution if the device limits or the memory are too small.
ShadowMap make_shadow_map(const gl::Context& context, const MapLayout& layout);

/// Whether the map's textures have the size and the number of layers that this layout needs.
bool has_textures_for(const ShadowMap& map, const MapLayout& layout);

/// Draws the map with the layout map.layout and overwrites its textures. See draw_shadow_map().
void redraw_shadow_map(const gl::Context& context, const UploadedScene& scene, const Light& light, ShadowMap& map,
                       const MapDepthParams& params = {});

/// Draws both faces of every triangle, unless params.faces says otherwise; masked materials are alpha-tested. Whatever
/// the parameters store, map.depth gets the linear depth that it stands for. Throws what make_shadow_map() and
/// require_sense() throw, and Error (usage) if the device lacks the format.
ShadowMap draw_shadow_map(const gl::Context& context, const UploadedScene& scene, const Light& light,
                          const MapLayout& layout, const MapDepthParams& params = {});

/// The nearest and the farthest depth in the map, metres; nothing if the light hits no surface.
std::optional<DepthRange> depth_range_of(const gl::Context& context, const ShadowMap& map);

ShadowMapImages read_back(const gl::Context& context, const ShadowMap& map);

}  // namespace umbrameter
