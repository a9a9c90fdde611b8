// Draws one layer of surfaces into the textures of a shadow map, and passes over its texels.
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

/// Of the texture that is drawn: depth32f for f16, too.
gl::Format texture_format(MapDepthFormat format);

/// Clears the textures and draws the casters that params.faces selects, with the polygon offset of the parameters.
void draw_map_layer(const MapSource& source, const MapLayer& layer);

/// The two nearest layers of a map, linear depths in 32-bit floats.
struct MapLayers {
  const gl::Texture& nearest;
  const gl::Texture& second;
};

/// Computes the depth of params.surface from the layers, and stores it with a mapping of map_depth.h.
void combine_layers(const MapSource& source, const MapLayers& layers, const gl::Texture& stored, int mapping);

/// Computes the linear depth of each texel of a map with the parameters' format and encoding, and rounds f16 before.
void decode_depth_map(const MapSource& source, const gl::Texture& stored, const gl::Texture& linear);

/// The shift of the stored depth by a polygon offset of one unit at a stored depth of ½, found by drawing a triangle
/// with and without an offset. OpenGL leaves it to the driver. In a float format the unit of a triangle is that of its
/// largest depth: twice as large from ½ on, half as large below ¼, and so on.
double measure_offset_unit(const gl::Context& context, MapDepthFormat format);

}  // namespace umbrameter
