// What a technique makes of a shadow map before it is looked up. Nothing where it compares stored depths.
#pragma once

#include "raster/gl/context.h"
#include "raster/shadow/shadow_map.h"
#include "techniques/shadow/technique.h"

namespace umbrameter {

struct FilteredMap {
  gl::Texture moments;  ///< one layer a view; empty where the technique has none
};

/// Reads of the technique what filtered_map_parameters() lists.
FilteredMap filter_map(const gl::Context& context, const ShadowMap& map, const ShadowTechnique& technique);

}  // namespace umbrameter
