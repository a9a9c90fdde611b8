// The faces and the surface whose depth a shadow map holds. known_answers_gl_test.cpp has the notation.
#include <algorithm>
#include <cmath>

#include "map_depth_cases.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

class MapSurfaceGl : public MapDepthGl {};

TEST_F(MapSurfaceGl, Faces_select_what_the_light_sees_from_front_or_behind) {
  Scene scene;
  const std::uint32_t front = add_mesh(scene, quad({-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1}));
  const std::uint32_t back = add_mesh(scene, quad({-1, 0.5f, -1}, {1, 0.5f, -1}, {1, 0.5f, 1}, {-1, 0.5f, 1}));
  dmat4 mirror(1.0);
  mirror[1][1] = -1.0;
  mirror[3] = dvec4(0, 0.25, 0, 1);  // at −0.25 m, seen from the front
  scene.instances.push_back({1, 1, mirror});
  for (const Light& light :
       {directional_light({0, 1, 0}), spot_light({0, 3, 0}, {0, 0, 0.001}, 0.2), point_light({0, 3, 0})}) {
    const MapLayout layout = fit_light(light, bounds_of(scene), 33);
    const auto count = [&](CasterFaces faces, std::uint32_t instance) {
      MapDepthParams params;
      params.faces = faces;
      std::ptrdiff_t texels = 0;
      for (const Image<std::uint32_t>& view : draw(scene, light, layout, params).instance) {
        texels += std::count(view.pixels.begin(), view.pixels.end(), instance);
      }
      return texels;
    };
    EXPECT_GT(count(CasterFaces::all, front), 10);
    EXPECT_GT(count(CasterFaces::front, front), 10);
    EXPECT_EQ(count(CasterFaces::front, back), 0);
    EXPECT_EQ(count(CasterFaces::back, front), 0);
    EXPECT_GT(count(CasterFaces::back, back), 10);
    EXPECT_EQ(count(CasterFaces::back, 2), 0);
    scene.materials[0].double_sided = true;
    EXPECT_GT(count(CasterFaces::back, front), 10);
    scene.materials[0].double_sided = false;
  }
}

// The second layer is what a map without the first would hold.
TEST_F(MapSurfaceGl, The_second_surface_is_the_nearest_without_the_first) {
  Scene below;
  add_mesh(below, quad({-4, 0, 4}, {4, 0.5f, 4}, {4, 0.5f, -4}, {-4, 0, -4}));
  Scene both = below;
  const Mesh plate = quad({-2, 1, 2}, {2, 1.25f, 2}, {2, 1.25f, -2}, {-2, 1, -2});
  const std::uint32_t first = add_mesh(both, plate);
  Scene doubled = both;
  add_mesh(doubled, plate);
  for (const Light& light : lights()) {
    const MapLayout layout = fit_light(light, bounds_of(both), 64);
    const ShadowMapImages nearest = draw(both, light, layout);
    const ShadowMapImages lower = draw(below, light, layout);
    const ShadowMapImages second = draw(both, light, layout, of_surface(StoredSurface::second));
    const ShadowMapImages of_doubled = draw(doubled, light, layout, of_surface(StoredSurface::second));
    const ShadowMapImages midpoint = draw(both, light, layout, of_surface(StoredSurface::midpoint));
    MapDepthParams dual = of_surface(StoredSurface::dual);
    dual.dual_offset = 0.1;
    const ShadowMapImages layered = draw(both, light, layout, dual);
    int covered = 0;
    for (std::size_t view = 0; view < second.depth.size(); ++view) {
      ASSERT_EQ(second.depth[view].pixels, of_doubled.depth[view].pixels);
      for (std::size_t i = 0; i < second.depth[view].size(); ++i) {
        const float front = nearest.depth[view][i];
        const bool is_covered = nearest.instance[view][i] == first && lower.depth[view][i] < 1.0f;
        const float behind = is_covered ? lower.depth[view][i] : 1.0f;
        ASSERT_EQ(second.depth[view][i], behind);
        ASSERT_EQ(second.instance[view][i], is_covered ? 0u : no_id);
        ASSERT_EQ(midpoint.depth[view][i], is_covered ? 0.5f * (front + behind) : 1.0f);
        ASSERT_EQ(midpoint.instance[view][i], nearest.instance[view][i]);
        const float offset = static_cast<float>(0.1 / layout.far_depth);
        const float expected = std::min(midpoint.depth[view][i], front + offset);
        ASSERT_NEAR(layered.depth[view][i], front < 1.0f ? expected : 1.0f, 1.3e-7f);
        if (is_covered) ++covered;
      }
    }
    EXPECT_GT(covered, 100);
  }
}

TEST_F(MapSurfaceGl, A_combined_surface_is_stored_in_the_format_too) {
  Scene scene = make_floor();
  add_mesh(scene, box({-2, 1, -2}, {2, 1.5f, 2}));
  for (const Light& light : lights()) {
    const MapLayout layout = fit_light(light, bounds_of(scene), 64);
    const ShadowMapImages exact = draw(scene, light, layout, of_surface(StoredSurface::midpoint));
    MapDepthParams params = stored_as(MapDepthFormat::fixed16, DepthEncoding::reversed);
    params.surface = StoredSurface::midpoint;
    const ShadowMapImages found = draw(scene, light, layout, params);
    for (std::size_t view = 0; view < exact.depth.size(); ++view) {
      for (std::size_t i = 0; i < exact.depth[view].size(); ++i) {
        const double depth = static_cast<double>(exact.depth[view][i]) * layout.far_depth;
        const double step = 1.75 * depth_step(params, layout, depth);
        ASSERT_NEAR(static_cast<double>(found.depth[view][i]) * layout.far_depth, depth,
                    exact.depth[view][i] < 1.0f ? 0.51 * step + 1e-6 * layout.far_depth : 0.0);
      }
    }
  }
}

// The lit top of a slab 2 m thick, under texels of 10 cm and no bias. A nearest tap needs t (p + q) tan θ / 2, which
// the depth between the top and what the map stores has to exceed: 2 m / cos θ for the bottom, half of that for the
// midpoint, the offset for dual layers.
TEST_F(MapSurfaceGl, Surfaces_behind_the_lit_one_free_a_closed_body_of_acne) {
  Scene scene;
  add_mesh(scene, box({-100, -2, -100}, {100, 0, 100}));
  const UploadedScene uploaded = upload(context(), scene);
  const GpuGBuffer surfels = upload(context(), surfels_on_ground(64, 64, -2, 2, -2, 2));
  ShadowParams shadow;
  shadow.bias.constant = 0.0;
  MapDepthParams back;
  back.faces = CasterFaces::back;
  MapDepthParams dual = of_surface(StoredSurface::dual);
  dual.dual_offset = 0.3;
  for (const double theta : {10.0, 45.0, 70.0, 80.0, 85.0}) {
    const double psi = 30.0;
    const MapLayout layout =
        exact_layout({std::sin(theta * degrees), std::cos(theta * degrees), 0}, 256, 0.1, psi * degrees);
    const auto lit = [&](const MapDepthParams& params) {
      const ShadowMap map = draw_shadow_map(context(), uploaded, light_of(layout), layout, params);
      return mean(
          draw_visibility(context(), {uploaded, surfels, map, light_of(layout), shadow.bias, make_technique(shadow)})
              .visibility);
    };
    EXPECT_NEAR(lit({}), 0.5, 0.05) << theta;
    EXPECT_EQ(lit(of_surface(StoredSurface::midpoint)), 1.0) << theta;
    EXPECT_EQ(lit(of_surface(StoredSurface::second)), 1.0) << theta;
    EXPECT_EQ(lit(back), 1.0) << theta;
    const double needed = 0.5 * 0.1 * (std::cos(psi * degrees) + std::sin(psi * degrees)) * std::tan(theta * degrees);
    EXPECT_EQ(lit(dual) == 1.0, needed < 0.3) << theta << " " << needed;
  }
}

// The lit strip behind a wall of thickness w is max(0, b cos e − w) wide where the map holds the wall's front, and
// loses of w what the map's depth lies behind it: all for the second surface and for back faces, half for the midpoint,
// the offset's part for dual layers.
TEST_F(MapSurfaceGl, Surfaces_behind_the_lit_one_peter_pan_by_the_thickness_that_they_skip) {
  constexpr double wall = 0.1;
  const double elevation = 40.0 * degrees;
  Scene scene;
  add_mesh(scene, ground(30.0f));
  add_mesh(scene, box({-wall, 0, -20}, {0, 3, 20}));
  const UploadedScene uploaded = upload(context(), scene);
  const double width = 0.5;
  const GpuGBuffer surfels = upload(context(), surfels_on_ground(256, 256, 0, width, -2, 2));
  const MapLayout layout = exact_layout({-std::cos(elevation), std::sin(elevation), 0}, 2048, 10.0 / 2048, 0.35);
  MapDepthParams back;
  back.faces = CasterFaces::back;
  MapDepthParams dual = of_surface(StoredSurface::dual);
  dual.dual_offset = 0.04;
  struct Case {
    MapDepthParams params;
    double skipped;
  };
  for (const Case& c :
       {Case{{}, 0.0}, Case{of_surface(StoredSurface::second), wall}, Case{back, wall},
        Case{of_surface(StoredSurface::midpoint), 0.5 * wall}, Case{dual, 0.04 * std::cos(elevation)}}) {
    const ShadowMap map = draw_shadow_map(context(), uploaded, light_of(layout), layout, c.params);
    for (const double bias : {0.03, 0.1, 0.2, 0.35}) {
      ShadowParams shadow;
      shadow.bias.constant = bias;
      const double strip = std::max(0.0, bias * std::cos(elevation) - (wall - c.skipped));
      const Image<float> visibility =
          draw_visibility(context(), {uploaded, surfels, map, light_of(layout), shadow.bias, make_technique(shadow)})
              .visibility;
      EXPECT_NEAR(mean(visibility) * width, strip, 0.003) << c.skipped << " " << bias;
    }
  }
}

}  // namespace
}  // namespace umbrameter
