// The fixture of tests that draw prefiltered shadow maps.
#pragma once

#include <vector>

#include "raster/shadow/prefiltered_pass.h"
#include "test_scenes.h"

namespace umbrameter::testing_scenes {

class PrefilteredGl : public GlTest {
 protected:
  // Mean visibility of surfels over x and z from −1 to 1 on the ground, under a map of texels of 5 cm.
  double seen(const Scene& scene, const Light& light, const MapLayout& layout, const ShadowParams& params) const {
    const UploadedScene uploaded = upload(context(), scene);
    const GpuGBuffer surfels = upload(context(), surfels_on_ground(16, 16, -1, 1, -1, 1));
    const ShadowMap map = draw_shadow_map(context(), uploaded, light, layout);
    return mean(see({uploaded, surfels, map, light}, params));
  }

  struct Drawn {
    const UploadedScene& scene;
    const GpuGBuffer& surfels;
    const ShadowMap& map;
    const Light& light;
    const View* view = nullptr;
  };
  Image<float> see(const Drawn& drawn, const ShadowParams& params) const {
    const ShadowTechnique technique = make_technique(params);
    const TechniqueMap filtered = filter_map({context(), drawn.scene, drawn.light, drawn.map}, technique);
    return draw_visibility(context(), {drawn.scene, drawn.surfels, drawn.map, drawn.light, params.bias, technique,
                                       nullptr, &filtered, drawn.view})
        .visibility;
  }
};

/// Every technique of the list that filters the map.
inline std::vector<ShadowTechniques::Choice> filtering_techniques() {
  std::vector<ShadowTechniques::Choice> all;
  ShadowTechniques::for_each([&]<class T>(std::type_identity<T>) {
    if constexpr (FiltersMap<T>) all.push_back(ShadowTechniques::choice<T>);
  });
  return all;
}

inline ShadowParams with(ShadowTechniques::Choice technique, Length bias = Length{0.01}) {
  ShadowParams params;
  params.technique = technique;
  params.bias.constant = bias;
  return params;
}

}  // namespace umbrameter::testing_scenes
