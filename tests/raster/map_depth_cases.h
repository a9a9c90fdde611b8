// Parameters, lights and a scene for tests of what a shadow map stores.
#pragma once

#include <vector>

#include "techniques/shadow/map_depth.h"
#include "test_scenes.h"

namespace umbrameter::testing_scenes {

inline constexpr double degrees = pi / 180.0;

inline MapDepthParams stored_as(MapDepthFormat format, DepthEncoding encoding, double near_depth = 0.1) {
  MapDepthParams params;
  params.format = format;
  params.encoding = encoding;
  params.near_depth = near_depth;
  return params;
}

inline MapDepthParams of_surface(StoredSurface surface) {
  MapDepthParams params;
  params.surface = surface;
  return params;
}

/// One of each kind.
inline std::vector<Light> lights() {
  return {directional_light({0.8, 2, 0.3}), spot_light({1, 3, 1}, {0, 0, 0}, 0.7), point_light({0.5, 2, 0.25})};
}

/// A floor of 8 m by 8 m; its corners are what the fitted maps reach to.
inline Scene make_floor() {
  Scene scene;
  add_mesh(scene, quad({-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}));
  return scene;
}

class MapDepthGl : public GlTest {
 protected:
  ShadowMapImages draw(const Scene& scene, const Light& light, const MapLayout& layout,
                       const MapDepthParams& params = {}) const {
    return read_back(context(), draw_shadow_map(context(), upload(context(), scene), light, layout, params));
  }
};

}  // namespace umbrameter::testing_scenes
