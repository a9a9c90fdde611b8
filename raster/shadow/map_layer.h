// Draws one layer of surfaces into the textures of a shadow map. Internal to raster.
#pragma once

#include "raster/gbuffer/uploaded_scene.h"
#include "raster/gl/context.h"
#include "techniques/shadow/map_depth.h"

namespace umbrameter {

/// What is drawn into a map.
struct MapSource {
  const gl::Context& context;
  const UploadedScene& scene;
  const Light& light;
  const MapLayout& layout;
  const MapDepthParams& params;
};

/// Where it is drawn: textures with one layer per view.
struct MapLayer {
  const gl::Texture& depth;
  const gl::Texture& ids;
  MapDepthFormat format = MapDepthFormat::f32;
  int mapping = 0;                        ///< of the depth: a constant in map_depth.h
  const gl::Texture* in_front = nullptr;  ///< linear depths of the layer in front, which is left out; or nullptr
};

gl::Format texture_format(MapDepthFormat format);

/// Clears the textures and draws the casters that params.faces selects, with the polygon offset of the parameters.
void draw_map_layer(const MapSource& source, const MapLayer& layer);

}  // namespace umbrameter
