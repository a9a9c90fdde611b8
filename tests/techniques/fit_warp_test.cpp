// The warp of a directional light's map, against the optimum that its paper derives.
#include "techniques/shadow/fit_warp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "core/error.h"
#include "techniques/shadow/map_depth.h"
#include "techniques/shadow/reference/lookup.h"

namespace umbrameter {
namespace {

constexpr int warp_resolution = 512;

// The ground that a camera at the origin sees along −z at depths of 1 to 100 m, half as wide to each side as far away.
GBuffer seen_ground() {
  GBuffer gbuffer(100, 3);
  for (std::size_t i = 0; i < gbuffer.depth.size(); ++i) {
    const float depth = static_cast<float>(1 + i % 100);
    gbuffer.instance[i] = gbuffer.triangle[i] = 0;
    gbuffer.depth[i] = depth;
    gbuffer.position[i] = vec3(0.5f * depth * (static_cast<float>(i / 100) - 1.0f), 0, -depth);
  }
  return gbuffer;
}

View wide_camera() {
  View view;
  view.width = 100;
  view.height = 100;
  view.camera.projection = PerspectiveProjection{.near_plane = 0.5};
  return view;
}

// Its y is turned away from the camera's view, which the fit undoes.
Light turned_sun(const dvec3& travels = {0, -1, 0}) {
  const dvec3 z = -glm::normalize(travels);
  const dvec3 x = glm::normalize(glm::cross(dvec3(0.3, 0.2, 0.8), z));
  Light light;
  light.shape = DirectionalLight{};
  light.world_from_light = dmat4(dvec4(x, 0), dvec4(glm::cross(z, x), 0), dvec4(z, 0), dvec4(0, 0, 0, 1));
  return light;
}

MapFitParams warped_fit() {
  MapFitParams fit;
  fit.fit = MapFit::view;
  fit.warp = Warp::lispsm;
  fit.warp_near = 0.5;
  fit.warp_far = 1000.0;
  return fit;
}

MapLayout fitted_warp(const MapFitParams& fit, const Light& light = turned_sun(), const View& view = wide_camera()) {
  Bounds bounds;
  bounds.include({-60, -1, -110});
  bounds.include({60, 1, 10});
  return fit_map(light, bounds, {warp_resolution, 1}, {seen_ground(), view}, fit);
}

// How far the warp's centre is behind the camera, metres.
double behind_camera(const MapLayout& layout) { return layout.light_from_world[3].y - layout.warp.value().center.y; }

dvec2 texels_of(const MapLayout& layout, const dvec3& position) { return project_to_map(layout, position).texels; }

// n = zₙ + √(zₙ z_f) = 11 m, so that w = z + 10 m and a texel is c (z + 10)² long: c · 121 z at both ends, where z is 1
// and 100 m, and c · 40 z at √100 m. (Wimmer, Scherzer and Purgathofer, section 4.)
TEST(MapWarp, Under_a_light_across_the_view_both_ends_of_it_get_texels_of_one_size_in_the_image) {
  const MapLayout layout = fitted_warp(warped_fit());
  ASSERT_TRUE(layout.warp);
  EXPECT_NEAR(behind_camera(layout), 10.0, 1e-9);
  const auto texel_per_depth = [&](double z) {
    const double step = 1e-4 * z;
    const dvec2 moved = texels_of(layout, {0, 0, -z - step}) - texels_of(layout, {0, 0, -z + step});
    EXPECT_NEAR(moved.x, 0.0, 1e-6) << "the view runs along y";
    return 2.0 * step / moved.y / z;
  };
  EXPECT_NEAR(texel_per_depth(100.0) / texel_per_depth(1.0), 1.0, 1e-6);
  EXPECT_NEAR(texel_per_depth(10.0) / texel_per_depth(1.0), 40.0 / 121.0, 1e-6);
  // From 1 to 100 m over 512 − 32 texels: ∫ dz / (z + 10)² = 1/11 − 1/110 = 9/110.
  EXPECT_NEAR(texel_per_depth(1.0), 121.0 * (9.0 / 110.0) / 480.0, 1e-6);
}

TEST(MapWarp, A_near_distance_that_is_skipped_moves_its_centre_away) {
  MapFitParams fit = warped_fit();
  fit.warp_near = 50.0;  // 49.5 m of 99 m: n = 49.5/(2 − 3 · 49.5/99) = 99 m, above 1 + √(50 · 100)
  EXPECT_NEAR(behind_camera(fitted_warp(fit)), 98.0, 1e-9);
  fit.warp_near = 67.0;  // more than two thirds
  EXPECT_FALSE(fitted_warp(fit).warp);
}

TEST(MapWarp, It_holds_what_is_seen_with_the_margin_of_a_cascade) {
  for (const dvec3& travels : {dvec3(0, -1, 0), dvec3(0.5, -1, -0.7), dvec3(-0.2, -1, 3)}) {
    const MapLayout layout = fitted_warp(warped_fit(), turned_sun(travels));
    ASSERT_TRUE(layout.warp);
    const GBuffer seen = seen_ground();
    dvec2 low(warp_resolution);
    dvec2 high(0);
    for (const vec3& position : seen.position.pixels) {
      const dvec3 p(position);
      low = glm::min(low, texels_of(layout, p));
      high = glm::max(high, texels_of(layout, p));
      EXPECT_TRUE(is_inside(layout, p));
    }
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(low[axis], map_view_margin, 1e-6);
      EXPECT_NEAR(high[axis], warp_resolution - map_view_margin, 1e-6);
    }
    EXPECT_FALSE(is_inside(layout, {0, 0, 20})) << "behind the camera";
  }
}

TEST(MapWarp, The_ray_of_a_texel_meets_the_map_at_its_centre_and_the_longer_side_is_its_size) {
  const MapLayout layout = fitted_warp(warped_fit(), turned_sun({0.5, -1, -0.7}));
  const dmat4 world_from_light = glm::inverse(layout.light_from_world);
  for (const ivec2 texel : {ivec2(20, 20), ivec2(300, 100), ivec2(490, 480)}) {
    const TexelRay ray = texel_ray(layout, texel, 0);
    EXPECT_EQ(ray.direction, dvec3(0, 0, -1)) << "the light's rays stay parallel";
    const dvec3 at(world_from_light * dvec4(ray.origin - dvec3(0, 0, 1.0), 1.0));
    EXPECT_NEAR(glm::length(texels_of(layout, at) - dvec2(texel) - 0.5), 0.0, 1e-6);
    const dvec3 right =
        texel_ray(layout, texel + ivec2(1, 0), 0).origin - texel_ray(layout, texel - ivec2(1, 0), 0).origin;
    const dvec3 up =
        texel_ray(layout, texel + ivec2(0, 1), 0).origin - texel_ray(layout, texel - ivec2(0, 1), 0).origin;
    const double longer = 0.5 * std::max(glm::length(right), glm::length(up));
    EXPECT_NEAR(texel_at(layout, at) / longer, 1.0, 1e-3);
  }
}

TEST(MapWarp, There_is_none_along_the_light_or_for_an_orthographic_camera) {
  EXPECT_FALSE(fitted_warp(warped_fit(), turned_sun({0, -0.01, -1})).warp);
  View flat = wide_camera();
  flat.camera.projection = OrthographicProjection{};
  EXPECT_FALSE(fitted_warp(warped_fit(), turned_sun(), flat).warp);
  EXPECT_FALSE(fitted_warp({}).warp);
}

TEST(MapWarp, Only_a_single_map_that_is_fitted_tightly_to_the_view_is_warped) {
  const Light light = turned_sun();
  EXPECT_NO_THROW(require_sense({warp_resolution, 1}, warped_fit(), {&light, 1}));
  EXPECT_THROW(require_sense({warp_resolution, 2}, warped_fit(), {&light, 1}), Error);
  for (const auto change : {+[](MapFitParams& fit) { fit.fit = MapFit::scene; },
                            +[](MapFitParams& fit) { fit.cascade_fit = CascadeFit::stable; }}) {
    MapFitParams fit = warped_fit();
    change(fit);
    EXPECT_THROW(require_sense({warp_resolution, 1}, fit, {&light, 1}), Error);
  }
}

// From the top of the bounds, at y = 1, to the ground: 1 m; n = 11 m. ½ + 11 (z − z_m) / w is 0 and 1 at w = 11 m.
TEST(MapWarp, The_depth_over_w_fills_the_range_at_the_near_end_of_the_volume) {
  const MapLayout layout = fitted_warp(warped_fit());
  const MapWarp& warp = layout.warp.value();
  const dvec2 depths(warp.middle_depth, warp.depth_scale);
  EXPECT_NEAR(warp.depth_scale, 11.0, 1e-6);
  struct Case {
    double y;
    double w;
    double stored;
  };
  for (const auto& [y, w, stored] : {Case{1, 11, 0}, Case{0, 11, 1}, Case{0, 110, 0.55}, Case{0.5, 110, 0.5}}) {
    const double depth = depth_of(layout, {0, y, -1});
    EXPECT_NEAR(shared::encode_over_w(shared::DEPTH_OVER_W, depth, w, depths), stored, 1e-6);
    const double reversed = shared::encode_over_w(shared::DEPTH_REVERSED_OVER_W, depth, w, depths);
    EXPECT_NEAR(reversed, 1.0 - stored, 1e-6);
    EXPECT_NEAR(shared::decode_over_w(shared::DEPTH_REVERSED_OVER_W, reversed, w, depths), depth, 1e-9);
  }
}

TEST(MapWarp, A_normal_offset_of_the_middle_texel_is_a_length) {
  const MapLayout layout = fitted_warp(warped_fit());
  const dvec2 middle = from_warped(layout.warp.value(), dvec2(0.0));
  const NormalOffset offset{2.0, 0.5, OffsetProfile::constant};
  const NormalOffset placed = placed_offset(layout, offset, OffsetTexel::middle);
  EXPECT_EQ(placed.texels, 0.0);
  EXPECT_NEAR(placed.metres, 0.5 + 2.0 * warped_texel(*layout.warp, warp_resolution, middle), 1e-12);
  EXPECT_EQ(placed_offset(layout, offset, OffsetTexel::receiver).texels, 2.0);
}

TEST(MapFit, A_given_area_has_its_own_depths_where_they_hold_the_scene) {
  Bounds bounds;
  bounds.include({-60, -1, -110});
  bounds.include({60, 1, 10});
  const dvec3 center = bounds.center();
  MapFitParams fit;
  fit.fit = MapFit::bounds;
  fit.fit_z = center.z;
  const auto fitted = [&](double depth) {
    fit.fit_depth = depth;
    return fit_map(turned_sun(), bounds, {256, 1}, {seen_ground(), wide_camera()}, fit);
  };
  EXPECT_NEAR(fitted(1e4).far_depth, 1e4, 1e-9);
  EXPECT_NEAR(depth_of(fitted(1e4), center), 5e3, 1e-9);
  EXPECT_EQ(fitted(1e-3).far_depth, fitted(0.0).far_depth) << "the scene is deeper";
  EXPECT_EQ(depth_of(fitted(1e-3), center), depth_of(fitted(0.0), center));
}

}  // namespace
}  // namespace umbrameter
