// The filtered shadow map of a technique, computed before the look-up. A technique that compares depths has none.
#pragma once

#include "raster/gl/context.h"
#include "raster/shadow/shadow_map.h"
#include "techniques/shadow/technique.h"

namespace umbrameter {

struct FilteredMap {
  gl::Texture values;  ///< one layer per view; empty if the technique has no filtered map
};

/// A map, and what it was drawn from.
struct DrawnMap {
  const gl::Context& context;
  const UploadedScene& scene;
  const Light& light;
  const ShadowMap& map;
  MapDepthParams depth{};
};

/// Depends only on the technique's parameters that filtered_map_parameters() lists.
FilteredMap filter_map(const DrawnMap& drawn, const ShadowTechnique& technique);

}  // namespace umbrameter
