#include "techniques/shadow/cascades.h"

#include <gtest/gtest.h>

namespace umbrameter {
namespace {

// A row of surfels on the ground along −z, seen from the origin at depths 1 to 100.
GBuffer row_of_surfels() {
  GBuffer gbuffer(100, 1);
  for (int i = 0; i < 100; ++i) {
    const auto at = static_cast<std::size_t>(i);
    gbuffer.instance[at] = 0;
    gbuffer.triangle[at] = 0;
    gbuffer.depth[at] = static_cast<float>(i + 1);
    gbuffer.position[at] = vec3(0, 0, -static_cast<float>(i + 1));
  }
  return gbuffer;
}

Light sun() {
  Light light;
  light.shape = DirectionalLight{};
  // It shines down: its −z is the world's −y.
  light.world_from_light = dmat4(dvec4(1, 0, 0, 0), dvec4(0, 0, -1, 0), dvec4(0, 1, 0, 0), dvec4(0, 0, 0, 1));
  return light;
}

Bounds scene_bounds() {
  Bounds bounds;
  bounds.include({-100, 0, -100});
  bounds.include({100, 1, 100});
  return bounds;
}

TEST(Cascades, Splits_lie_halfway_between_uniform_and_logarithmic) {
  const std::vector<double> splits = split_depths(1.0, 100.0, 2);
  ASSERT_EQ(splits.size(), 2u);
  EXPECT_NEAR(splits[0], 0.5 * (10.0 + 50.5), 1e-12);  // √(1·100) and 1 + 99/2
  EXPECT_NEAR(splits[1], 100.0, 1e-9);
}

TEST(Cascades, One_is_the_map_fitted_to_the_scene) {
  const MapLayout one = fit_map(sun(), scene_bounds(), {512, 1}, {row_of_surfels()});
  const MapLayout fitted = fit_light(sun(), scene_bounds(), 512);
  ASSERT_EQ(one.views.size(), 1u);
  EXPECT_EQ(one.views[0].half_extent, fitted.views[0].half_extent);
}

TEST(Cascades, The_near_view_holds_what_is_seen_up_to_its_split_and_is_finer) {
  const MapLayout layout = fit_map(sun(), scene_bounds(), {512, 2}, {row_of_surfels()});
  ASSERT_EQ(layout.views.size(), 2u);
  // Depths 1 to 30 (the split is 30.25) span 29 m; 512 − 32 texels hold them.
  EXPECT_NEAR(layout.views[0].half_extent, 0.5 * 29.0 * 512 / 480, 1e-9);
  for (const double depth : {1.0, 15.0, 30.0}) {
    EXPECT_NEAR(texel_at(layout, {0, 0, -depth}), 29.0 / 480, 1e-9) << depth;
  }
  const double coarse = 2.0 * layout.views[1].half_extent / 512;
  for (const double depth : {32.0, 100.0}) EXPECT_EQ(texel_at(layout, {0, 0, -depth}), coarse) << depth;
  EXPECT_TRUE(is_inside(layout, {0, 0, -100}));
}

TEST(Cascades, A_view_no_finer_than_the_whole_map_is_left_out) {
  Bounds small;
  small.include({-1, 0, -101});
  small.include({1, 1, 0});
  GBuffer far = row_of_surfels();
  for (std::size_t i = 0; i < far.depth.size(); ++i) far.depth[i] = 50.0f;
  EXPECT_EQ(fit_map(sun(), small, {512, 4}, {far}).views.size(), 1u);
}

TEST(Cascades, Other_lights_have_their_own_views) {
  Light lamp;
  lamp.shape = PointLight{};
  EXPECT_EQ(fit_map(lamp, scene_bounds(), {256, 4}, {row_of_surfels()}).views.size(), 6u);
}

TEST(Cascades, A_view_without_surfaces_gets_one_map) {
  EXPECT_EQ(fit_map(sun(), scene_bounds(), {256, 4}, {GBuffer(4, 4)}).views.size(), 1u);
}

}  // namespace
}  // namespace umbrameter
