// Passes over the texels of a drawn shadow map: the linear depth that look-ups read. Internal to raster.
#pragma once

#include <optional>

#include "raster/shadow/map_layer.h"

namespace umbrameter {

/// The two nearest layers of a map, linear depths in 32-bit floats.
struct MapLayers {
  const gl::Texture& nearest;
  const gl::Texture& second;
};

/// Computes the depth of params.surface from the layers, and stores it with a mapping of map_depth.h.
void combine_layers(const MapSource& source, const MapLayers& layers, const gl::Texture& stored, int mapping);

/// Computes the linear depth of each texel of a map with the parameters' format and encoding.
void decode_depth_map(const MapSource& source, const gl::Texture& stored, const gl::Texture& linear);

}  // namespace umbrameter
