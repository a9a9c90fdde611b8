// Exponential shadow maps against their formula.
#include <cmath>

#include "raster/shadow/esm_pass.h"
#include "test_scenes.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

class EsmGl : public GlTest {
 protected:
  // Mean visibility of surfels over x and z from −1 to 1 on the ground, under a map of texels of 5 cm.
  double seen(const Scene& scene, const Light& light, const MapLayout& layout, const ShadowParams& params) const {
    const UploadedScene uploaded = upload(context(), scene);
    const GpuGBuffer surfels = upload(context(), surfels_on_ground(16, 16, -1, 1, -1, 1));
    const ShadowMap map = draw_shadow_map(context(), uploaded, light, layout);
    const ShadowTechnique technique = make_technique(params);
    const FilteredMap filtered = filter_map(context(), map, technique);
    const RasterVisibility drawn =
        draw_visibility(context(), {uploaded, surfels, map, light, params.bias, technique, nullptr, &filtered});
    return mean(drawn.visibility);
  }
};

ShadowParams esm(double exponent, int blur) {
  ShadowParams params;
  params.bias.constant = 0.0;
  params.technique = ShadowTechniqueName::esm;
  params.esm = {exponent, blur};
  return params;
}

TEST_F(EsmGl, Under_a_wide_slab_visibility_is_the_exponential_of_the_gap) {
  Scene scene;
  add_mesh(scene, ground(60));
  add_mesh(scene, quad({-20, 2, 20}, {20, 2, 20}, {20, 2, -20}, {-20, 2, -20}));
  const MapLayout layout = exact_layout({0.001, 1, 0.002}, 128, 0.05, 0);
  for (const double exponent : {1.0, 10.0, 40.0}) {
    for (const int blur : {1, 7}) {
      // exp(−c·d)·exp(c·z) = exp(−c·(d − z)), and d − z is the slab's height over the depth range.
      const double expected = std::exp(-exponent * 2.0 / layout.far_depth);
      // Single precision holds the product to about c·2⁻²³ of itself, and the light leans by 1/500.
      EXPECT_NEAR(seen(scene, light_of(layout), layout, esm(exponent, blur)), expected, 1e-3 * expected + 1e-6)
          << exponent << " " << blur;
    }
  }
}

TEST_F(EsmGl, An_open_plane_is_lit_by_every_kind_of_light) {
  Scene scene;
  add_mesh(scene, ground(60));
  const MapLayout flat = exact_layout({0.001, 1, 0.002}, 128, 0.05, 0);
  ShadowParams params = esm(40.0, 3);
  params.bias.constant = 0.01;
  EXPECT_EQ(seen(scene, light_of(flat), flat, params), 1.0);
  const Light point = point_light({0.1, 3, 0.2});
  params.bias.constant = 0.1;
  EXPECT_EQ(seen(scene, point, fit_light(point, bounds_of(scene), 512), params), 1.0);
}

TEST_F(EsmGl, A_blurred_edge_passes_one_half_where_the_kernel_is_half_covered) {
  // A slab over x < 0. At the edge half of the box holds its depth, whose exponential is small beside the ground's:
  // visibility is 1/2 and a little, (1 + exp(−c·gap/far))/2.
  Scene scene;
  add_mesh(scene, ground(60));
  add_mesh(scene, quad({-20, 2, 20}, {0, 2, 20}, {0, 2, -20}, {-20, 2, -20}));
  const MapLayout layout = exact_layout({0, 1, 1e-9}, 128, 0.05, 0);
  const UploadedScene uploaded = upload(context(), scene);
  GBuffer one = surfels_on_ground(1, 1, 0, 1, 0, 1);
  one.position[0] = vec3(0.0f, 0, 0.3f);
  const GpuGBuffer surfel = upload(context(), one);
  const ShadowMap map = draw_shadow_map(context(), uploaded, light_of(layout), layout);
  const ShadowParams params = esm(40.0, 9);
  const ShadowTechnique technique = make_technique(params);
  const FilteredMap filtered = filter_map(context(), map, technique);
  const Image<float> seen =
      draw_visibility(context(), {uploaded, surfel, map, light_of(layout), params.bias, technique, nullptr, &filtered})
          .visibility;
  const double expected = 0.5 * (1.0 + std::exp(-40.0 * 2.0 / layout.far_depth));
  EXPECT_NEAR(static_cast<double>(seen[0]), expected, 1e-3);
}

}  // namespace
}  // namespace umbrameter
