// Screen-space shadows: shadows of known length, and the shaders against the CPU.
#include <algorithm>
#include <cmath>
#include <vector>

#include "raster/shadow/technique_passes.h"
#include "scenes/builtin/scenes.h"
#include "test_scenes.h"
#include "tests/support/reference/screen_space.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

class ScreenSpaceGl : public GlTest {
 protected:
  struct Drawn {
    const Scene& scene;
    const View& view;
    const Light& light;
  };
  Image<float> see(const Drawn& drawn, const ShadowParams& params) const {
    const UploadedScene uploaded = upload(context(), drawn.scene);
    const GpuGBuffer surfels = draw_gbuffer(context(), uploaded, drawn.view);
    const ShadowMap map =
        draw_shadow_map(context(), uploaded, drawn.light, fit_light(drawn.light, bounds_of(drawn.scene), 256));
    const ShadowTechnique technique = make_technique(params);
    const TechniqueMap filtered = filter_map({context(), uploaded, drawn.light, map}, technique);
    return draw_visibility(context(), {uploaded, surfels, map, drawn.light, params.bias, technique, nullptr, &filtered,
                                       &drawn.view})
        .visibility;
  }
  GBuffer surfels_of(const Drawn& drawn) const {
    return read_back(context(), draw_gbuffer(context(), upload(context(), drawn.scene), drawn.view));
  }
};

ShadowParams march(double length, int steps) {
  ShadowParams params;
  params.technique = ShadowTechniques::choice<ScreenSpace>;
  params.screen_space = {false, length, steps, 1e3, 1e-4, false};
  return params;
}

// A wall along x, without thickness, on a plane. The light comes from behind it.
Scene wall(float height) {
  Scene scene;
  add_mesh(scene, ground(40));
  add_mesh(scene, quad({-30, 0, 0}, {30, 0, 0}, {30, height, 0}, {-30, height, 0}));
  return scene;
}

TEST_F(ScreenSpaceGl, The_shadow_of_a_wall_is_as_long_as_the_march_reaches_or_as_it_is) {
  constexpr double height = 1.0;
  const Scene scene = wall(static_cast<float>(height));
  for (const double elevation : {0.6, 0.9}) {
    const Light light = directional_light({0, std::sin(elevation), -std::cos(elevation)});
    for (const View& view : {perspective_view(60, 600, {0.3, 4, 6}, {0.3, 0, 0.7}, 0.7),
                             orthographic_view(60, 600, {0.3, 4, 6}, {0.3, 0, 0.7}, 2.0)}) {
      for (const double length : {0.2, 0.5, 1.0, 4.0}) {
        const Drawn drawn{scene, view, light};
        const Image<float> seen = see(drawn, march(length, 500));
        const GBuffer gbuffer = surfels_of(drawn);
        // The ray crosses the wall at z/cos from the surfel, at the height z·tan.
        const double expected = std::min(length * std::cos(elevation), height / std::tan(elevation));
        double shadow = 0.0;
        double lit = 10.0;
        for (std::size_t i = 0; i < seen.size(); ++i) {
          const auto z = static_cast<double>(gbuffer.position[i].z);
          if (gbuffer.instance[i] != 0 || z <= 0.02) continue;
          (seen[i] == 0.0f ? shadow = std::max(shadow, z) : lit = std::min(lit, z));
        }
        // A pixel spans 1 cm of the ground, and a step of the ray at most 1/500 of its length.
        EXPECT_NEAR(shadow, expected, 0.025) << elevation << " " << length;
        EXPECT_NEAR(lit, expected, 0.025) << elevation << " " << length;
      }
    }
  }
}

TEST_F(ScreenSpaceGl, Behind_a_surface_of_its_thickness_the_ray_is_free) {
  // Seen along the wall's normal, the ray lies at most length·cos behind the wall.
  const Scene scene = wall(1.0f);
  const Light light = directional_light({0, 0.5, -1});
  const View view = perspective_view(60, 300, {0, 1.5, 6}, {0, 0.5, 0}, 0.7);
  const Drawn drawn{scene, view, light};
  ShadowParams params = march(0.5, 100);
  const auto blocked = [&] {
    const Image<float> seen = see(drawn, params);
    return std::count(seen.pixels.begin(), seen.pixels.end(), 0.0f);
  };
  const auto back_facing = [&] {
    params.screen_space.length = 0.0;
    return blocked();
  };
  const auto thick = blocked();
  params.screen_space.thickness = 0.002;
  const auto thin = blocked();
  params.screen_space.thickness = 0.0;
  const auto none = blocked();
  EXPECT_GT(thick, thin);
  EXPECT_GT(thin, none);
  EXPECT_EQ(none, back_facing());
}

TEST_F(ScreenSpaceGl, An_open_plane_is_lit_at_the_default_settings) {
  Scene scene;
  add_mesh(scene, ground(40));
  ShadowParams params;
  params.technique = ShadowTechniques::choice<ScreenSpace>;
  for (const bool jitter : {false, true}) {
    params.screen_space.jitter = jitter;
    for (const Light& light :
         {directional_light({1, 1, 1}), directional_light({-1, 0.5, 2}), point_light({1, 3, -2})}) {
      const View view = perspective_view(960, 540, {0, 2, 5}, {0, 0, 0});
      EXPECT_EQ(mean(see({scene, view, light}, params)), 1.0);
    }
  }
}

TEST_F(ScreenSpaceGl, The_shaders_march_as_the_CPU_does) {
  for (const Scene& scene : {builtin::make_contact_box(), builtin::make_two_occluders()}) {
    for (const View& view :
         {View{160, 90, scene.cameras[0]}, orthographic_view(160, 90, {3, 5, 6}, {0, 0.5, 0}, 3.0)}) {
      for (const Light& light : {scene.lights[0], spot_light({3, 6, 3}, {0, 0, 0}, 0.9), point_light({0.5, 1, 0.5})}) {
        for (const bool jitter : {false, true}) {
          ShadowParams params;
          params.technique = ShadowTechniques::choice<ScreenSpace>;
          params.screen_space = {false, 1.0, 16, 0.5, 0.002, jitter};
          const Drawn drawn{scene, view, light};
          const Image<float> seen = see(drawn, params);
          const Image<float> expected =
              march_depth_buffer(surfels_of(drawn), view, light, ScreenSpace::make(params, 0.0));
          std::size_t differs = 0;
          for (std::size_t i = 0; i < seen.size(); ++i) differs += seen[i] != expected[i] ? 1u : 0u;
          // Where a sample falls between two pixels, rounding decides.
          EXPECT_LE(differs, seen.size() / 2000);
          ShadowParams free = params;
          free.screen_space.length = 0.0;
          EXPECT_LT(mean(seen), mean(see(drawn, free)) - 0.002);
        }
      }
    }
  }
}

TEST_F(ScreenSpaceGl, Combined_with_a_map_a_pixel_is_as_dark_as_in_the_darker_of_both) {
  const Scene scene = builtin::make_contact_box();
  const View view{160, 90, scene.cameras[0]};
  const Drawn drawn{scene, view, scene.lights[0]};
  ShadowParams alone;
  alone.technique = ShadowTechniques::choice<ScreenSpace>;
  const Image<float> marched = see(drawn, alone);
  for (const ShadowTechniques::Choice name :
       {ShadowTechniques::choice<Pcf>, ShadowTechniques::choice<Vsm>, ShadowTechniques::choice<Csm>}) {
    ShadowParams params;
    params.technique = name;
    params.pcf.filter = ShadowFilter::box;
    EXPECT_EQ(capabilities_of(make_technique(params)).sums_comparisons, name == ShadowTechniques::choice<Pcf>);
    const Image<float> of_map = see(drawn, params);
    params.screen_space.is_combined = true;
    EXPECT_FALSE(capabilities_of(make_technique(params)).sums_comparisons);
    EXPECT_FALSE(capabilities_of(make_technique(params)).taps_independent_of_bias);
    const Image<float> both = see(drawn, params);
    for (std::size_t i = 0; i < both.size(); ++i) ASSERT_EQ(both[i], std::min(marched[i], of_map[i])) << i;
  }
}

}  // namespace
}  // namespace umbrameter
