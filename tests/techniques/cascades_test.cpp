#include "techniques/shadow/cascades.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "core/error.h"
#include "techniques/shadow/reference/lookup.h"

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

TEST(Cascades, Splits_can_be_given_as_rising_shares_of_the_range) {
  EXPECT_EQ(parse_splits("0.1,0.2,0.5", 4), (std::vector<double>{0.1, 0.2, 0.5}));
  EXPECT_EQ(parse_splits("0.25", 2), std::vector<double>{0.25});
  for (const char* text : {"0.1,0.2", "0.2,0.1,0.5", "0.1,0.2,1", "0.1,0.2,0.5,", "0.1;0.2;0.5", "0,0.2,0.5",
                           "nan,0.2,0.5", "0.1, 0.2,0.5", "0.1,,0.5"}) {
    EXPECT_THROW(parse_splits(text, 4), Error) << text;
  }
}

TEST(Cascades, Constant_biases_have_a_factor_for_each_cascade) {
  EXPECT_EQ(parse_cascade_bias("", 3), (std::vector<double>{1, 1, 1}));
  EXPECT_EQ(parse_cascade_bias("1,2.5,4", 3), (std::vector<double>{1, 2.5, 4}));
  EXPECT_EQ(parse_cascade_bias("own-range", 3), (std::vector<double>{1, 1, 1}));
  for (const char* text : {"1,2", "1,2,0", "1,2,-4", "1,2,4,", "1;2;4", "own", "nan,1,1"}) {
    EXPECT_THROW(parse_cascade_bias(text, 3), Error) << text;
  }
}

TEST(Cascades, A_cascades_own_range_is_its_side_and_the_near_offset) {
  MapFitParams fit;
  fit.cascade_bias = "own-range";
  fit.near_offset = 20.0;
  const MapLayout layout = fit_map(sun(), scene_bounds(), {512, 2}, {row_of_surfels()}, fit);
  ASSERT_EQ(layout.views.size(), 2u);
  for (const MapView& view : layout.views) {
    EXPECT_NEAR(view.range_share * layout.far_depth, 2.0 * view.half_extent + 20.0, 1e-9);
    EXPECT_EQ(bias_factor(view, LengthUnit::map_depth), view.range_share);
    EXPECT_EQ(bias_factor(view, LengthUnit::metres), 1.0) << "metres are metres";
  }
}

TEST(Cascades, Lambda_mixes_uniform_and_logarithmic_splits) {
  // Of 1 to 81 in four: 3, 9, 27, 81 and 21, 41, 61, 81. A quarter of the one and three quarters of the other.
  const double logarithmic[] = {3, 9, 27, 81};
  const double uniform[] = {21, 41, 61, 81};
  const double mixed[] = {16.5, 33, 52.5, 81};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(split_depths(1, 81, 4, 1.0)[i], logarithmic[i], 1e-12);
    EXPECT_NEAR(split_depths(1, 81, 4, 0.0)[i], uniform[i], 1e-12);
    EXPECT_NEAR(split_depths(1, 81, 4, 0.25)[i], mixed[i], 1e-12);
  }
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

// At the origin, looks along −z; 90° high and wide.
View camera_at(const dmat4& world_from_camera = dmat4(1.0)) {
  View view{64, 64, {}};
  view.camera.projection = PerspectiveProjection{pi / 2, 1.0};
  view.camera.world_from_camera = world_from_camera;
  return view;
}

MapFitParams stable_fit(MapFit fit) {
  MapFitParams params;
  params.fit = fit;
  params.cascade_fit = CascadeFit::stable;
  params.split_range = SplitRange::camera;
  params.max_distance = 41.0;
  params.split_lambda = 0.0;
  return params;
}

TEST(Cascades, A_given_area_has_its_own_size_and_centre) {
  MapFitParams fit;
  fit.fit = MapFit::bounds;
  fit.fit_x = 3.0;
  fit.fit_z = -50.0;
  fit.fit_size = 20.0;
  const MapLayout layout = fit_map(sun(), scene_bounds(), {256, 1}, {row_of_surfels()}, fit);
  EXPECT_NEAR(texel_at(layout, {3, 0, -50}), 20.0 / 256, 1e-12);
  EXPECT_TRUE(is_inside(layout, {-6.9, 0, -59.9}));
  EXPECT_FALSE(is_inside(layout, {-7.1, 0, -50}));
  EXPECT_FALSE(is_inside(layout, {3, 0, -60.1}));
  EXPECT_EQ(exclusion_of(sun(), layout, {3, 0, -61}, {0, 1, 0}), PixelExclusion::outside_map);
}

TEST(Cascades, The_area_of_the_view_holds_what_is_seen_and_no_more) {
  MapFitParams fit;
  fit.fit = MapFit::view;
  const MapLayout layout = fit_map(sun(), scene_bounds(), {512, 1}, {row_of_surfels()}, fit);
  ASSERT_EQ(layout.views.size(), 1u);
  // Depths 1 to 100 span 99 m; 512 − 32 texels hold them.
  EXPECT_NEAR(texel_at(layout, {0, 0, -1}), 99.0 / 480, 1e-9);
  EXPECT_FALSE(is_inside(layout, {0, 0, 30}));
}

TEST(Cascades, A_stable_area_is_as_large_as_the_bounding_sphere_of_its_part_of_the_frustum) {
  MapFitParams fit = stable_fit(MapFit::view);
  const MapLayout layout = fit_map(sun(), scene_bounds(), {512, 4}, {row_of_surfels(), camera_at()}, fit);
  ASSERT_EQ(layout.views.size(), 4u);
  // 1 to 41 m in steps of 10. The corners are √2 times the depth off the axis: k² = 2, so that the sphere's centre is
  // at min(1.5 (n + f), f) = f and its radius √2 f. 512 − 33 texels hold its diameter.
  for (std::size_t i = 0; i < 4; ++i) {
    const double far = 11.0 + 10.0 * static_cast<double>(i);
    EXPECT_NEAR(2.0 * layout.views[i].half_extent / 512, 2.0 * std::sqrt(2.0) * far / 479, 1e-9) << i;
  }
  // A narrow lens: vertical and horizontal tangent ¼, k² = 1/8. Of 1 to 41 m the centre is at 21 · 9/8 = 23.625 m.
  View narrow = camera_at();
  narrow.camera.projection = PerspectiveProjection{2.0 * std::atan(0.25), 1.0};
  const MapLayout one = fit_map(sun(), scene_bounds(), {512, 1}, {row_of_surfels(), narrow}, fit);
  const double radius = std::hypot(41.0 * std::sqrt(0.125), 41.0 - 23.625);
  EXPECT_NEAR(2.0 * one.views[0].half_extent / 512, 2.0 * radius / 479, 1e-9);
  EXPECT_NEAR(radius, std::hypot(1.0 * std::sqrt(0.125), 23.625 - 1.0), 1e-9) << "near and far corners are as distant";
}

TEST(Cascades, Turning_the_camera_changes_no_stable_size_and_moving_it_moves_areas_by_whole_texels) {
  for (const CascadeSelection selection : {CascadeSelection::map, CascadeSelection::depth}) {
    MapFitParams fit = stable_fit(MapFit::view);
    fit.selection = selection;
    const MapLayout before = fit_map(sun(), scene_bounds(), {512, 3}, {row_of_surfels(), camera_at()}, fit);
    bool has_moved = false;
    for (int i = 0; i < 20; ++i) {
      const dmat4 turned = glm::rotate(glm::translate(dmat4(1.0), dvec3(0.037 * i, 0.11 * i, 0.213 * i)), 0.3 * i,
                                       glm::normalize(dvec3(0.3, 1.0, 0.1)));
      const MapLayout after = fit_map(sun(), scene_bounds(), {512, 3}, {row_of_surfels(), camera_at(turned)}, fit);
      ASSERT_EQ(after.views.size(), before.views.size());
      for (std::size_t v = 0; v < before.views.size(); ++v) {
        EXPECT_EQ(after.views[v].half_extent, before.views[v].half_extent);
        const double texel = 2.0 * before.views[v].half_extent / 512;
        const dvec2 moved = (after.views[v].center - before.views[v].center) / texel;
        EXPECT_NEAR(moved.x, std::round(moved.x), 1e-9);
        EXPECT_NEAR(moved.y, std::round(moved.y), 1e-9);
        has_moved = has_moved || std::abs(moved.x) > 0.5;
      }
    }
    EXPECT_TRUE(has_moved);
  }
}

TEST(Cascades, Selected_by_depth_a_cascade_serves_its_own_range_and_holds_no_more) {
  MapFitParams fit;
  fit.selection = CascadeSelection::depth;
  fit.fit = MapFit::view;
  fit.split_lambda = 0.0;
  const MapLayout layout = fit_map(sun(), scene_bounds(), {512, 3}, {row_of_surfels(), camera_at()}, fit);
  ASSERT_EQ(layout.views.size(), 3u);
  // 1 to 100 m in steps of 33; a surfel at a split is held by both.
  for (int depth = 1; depth <= 100; ++depth) {
    const std::size_t expected = depth <= 34 ? 0 : depth <= 67 ? 1 : 2;
    EXPECT_NEAR(texel_at(layout, {0, 0, -depth}), 33.0 / 480, 1e-9) << depth;
    EXPECT_TRUE(is_inside(layout, {0, 0, -depth}));
    EXPECT_EQ(project_to_map(layout, {0, 0, -depth}).view, static_cast<int>(expected)) << depth;
    // In front of the camera's plane but far to its side the same cascade serves, though it does not hold the place.
    EXPECT_EQ(project_to_map(layout, {80, 0, -depth}).view, static_cast<int>(expected)) << depth;
  }
}

TEST(Cascades, Given_splits_end_the_cascades) {
  MapFitParams fit;
  fit.selection = CascadeSelection::depth;
  fit.fit = MapFit::view;
  fit.splits = "0.2,0.5";
  const MapLayout layout = fit_map(sun(), scene_bounds(), {512, 3}, {row_of_surfels(), camera_at()}, fit);
  // Of 1 to 100 m: 20.8 and 50.5.
  for (const auto& [depth, view] : {std::pair{20, 0}, {21, 1}, {50, 1}, {51, 2}}) {
    EXPECT_EQ(project_to_map(layout, {0, 0, -depth}).view, view) << depth;
  }
  EXPECT_THROW(fit_map(sun(), scene_bounds(), {512, 4}, {row_of_surfels(), camera_at()}, fit), Error);
}

TEST(Cascades, What_is_beyond_the_farthest_distance_is_outside_the_map) {
  MapFitParams fit = stable_fit(MapFit::view);
  fit.selection = CascadeSelection::depth;
  const MapLayout layout = fit_map(sun(), scene_bounds(), {512, 2}, {row_of_surfels(), camera_at()}, fit);
  EXPECT_TRUE(is_inside(layout, {0, 0, -40.9}));
  EXPECT_FALSE(is_inside(layout, {0, 0, -41.1}));
  EXPECT_FALSE(project_to_map(layout, {0, 0, -41.1}).is_inside);
  fit.fit = MapFit::scene;
  EXPECT_TRUE(is_inside(fit_map(sun(), scene_bounds(), {512, 2}, {row_of_surfels(), camera_at()}, fit), {0, 0, -99}));
}

TEST(Cascades, Shadows_fade_smoothly_over_the_last_share_of_the_distance) {
  MapFitParams fit = stable_fit(MapFit::view);
  fit.selection = CascadeSelection::depth;
  fit.fade = 0.5;
  const MapLayout layout = fit_map(sun(), scene_bounds(), {512, 2}, {row_of_surfels(), camera_at()}, fit);
  const auto is_inside_at = [&](double dither) { return project_to_map(layout, {0, 0, -25.625}, dither).is_inside; };
  EXPECT_TRUE(is_inside_at(0.0) && is_inside_at(0.84) && !is_inside_at(0.85));  // s² (3 − 2s) = 0.15625 at s = ¼
}

TEST(Cascades, A_blend_hands_over_linearly_over_its_share_of_the_extent) {
  for (const CascadeSelection selection : {CascadeSelection::map, CascadeSelection::depth}) {
    MapFitParams fit;
    fit.selection = selection;
    fit.split_lambda = 0.0;
    fit.blend = 0.5;
    const MapLayout layout = fit_map(sun(), scene_bounds(), {512, 2}, {row_of_surfels(), camera_at()}, fit);
    ASSERT_EQ(layout.views.size(), 2u);
    // By depth the zone is the far half of 1 to 50.5 m. By map the first cascade holds 1 to 50 m, with 25.5 in the
    // middle, and its zone is the outer half: 37.75 to 50 m on the far side.
    const double first = selection == CascadeSelection::depth ? 25.75 : 37.75;
    const double last = selection == CascadeSelection::depth ? 50.5 : 50.0;
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const double depth = first + (share * 0.98 + 0.01) * (last - first);
      int handed_over = 0;
      for (std::uint32_t p = 0; p < 64; ++p) {
        handed_over += project_to_map(layout, {0, 0, -depth}, dither_at(p % 8, p / 8)).view;
      }
      EXPECT_NEAR(handed_over / 64.0, share * 0.98 + 0.01, 1.0 / 64) << share;
    }
    for (std::uint32_t p = 0; p < 64; ++p) {
      EXPECT_EQ(project_to_map(layout, {0, 0, -(first - 0.1)}, dither_at(p % 8, p / 8)).view, 0);
      EXPECT_EQ(project_to_map(layout, {0, 0, -(last + 0.1)}, dither_at(p % 8, p / 8)).view, 1);
    }
  }
}

TEST(Cascades, A_position_that_the_next_cascade_does_not_hold_is_not_blended) {
  MapFitParams fit;
  fit.blend = 1.0;
  fit.fit = MapFit::bounds;  // the last: far from what is seen
  fit.fit_x = 500.0;
  fit.fit_size = 600.0;
  const MapLayout layout = fit_map(sun(), scene_bounds(), {512, 2}, {row_of_surfels()}, fit);
  ASSERT_EQ(layout.views.size(), 2u);
  for (std::uint32_t p = 0; p < 64; ++p) {
    EXPECT_EQ(project_to_map(layout, {0, 0, -2}, dither_at(p % 8, p / 8)).view, 0);
  }
}

TEST(Cascades, The_thresholds_of_a_tile_are_evenly_spaced) {
  std::set<double> thresholds;
  for (std::uint32_t p = 0; p < 64; ++p) thresholds.insert(dither_at(8 + p % 8, 16 + p / 8));
  ASSERT_EQ(thresholds.size(), 64u);
  EXPECT_EQ(*thresholds.begin(), 0.5 / 64);
  EXPECT_EQ(*thresholds.rbegin(), 63.5 / 64);
  // Row 0 of the matrix: 0 32 8 40 2 34 10 42.
  EXPECT_EQ(dither_at(1, 0), 32.5 / 64);
  EXPECT_EQ(dither_at(2, 0), 8.5 / 64);
  EXPECT_EQ(dither_at(0, 1), 48.5 / 64);
}

TEST(Cascades, Pancaking_starts_the_depths_before_the_nearest_receiver_but_not_before_the_scene) {
  Bounds tall = scene_bounds();
  tall.include({0, 50, 0});
  MapFitParams fit;
  fit.pancaking = true;
  fit.near_offset = 2.0;
  const MapLayout whole = fit_light(sun(), tall, 512);
  const MapLayout layout = fit_map(sun(), tall, {512, 1}, {row_of_surfels()}, fit);
  EXPECT_NEAR(whole.far_depth, 50.0, 1e-3);
  EXPECT_NEAR(layout.far_depth, 2.0, 1e-3);
  EXPECT_NEAR(depth_of(layout, {0, 0, -10}), 2.0, 1e-9);
  EXPECT_EQ(texel_at(layout, {0, 0, -10}), texel_at(whole, {0, 0, -10}));
  fit.near_offset = 60.0;
  EXPECT_EQ(fit_map(sun(), tall, {512, 1}, {row_of_surfels()}, fit).far_depth, whole.far_depth);
}

TEST(Cascades, The_ground_lies_within_the_depths_of_a_map_whose_area_it_does_not_change) {
  Bounds scene;
  scene.include({-1, 0, -1});
  scene.include({1, 3, 1});
  Bounds ground;
  ground.include({-8, 0, -8});
  ground.include({8, 0, 8});
  GBuffer gbuffer = row_of_surfels();
  for (const double elevation : {90.0, 60.0, 20.0, 1.0, 0.0, -30.0}) {
    for (const CascadeSelection selection : {CascadeSelection::map, CascadeSelection::depth}) {
      for (const MapFit area : {MapFit::scene, MapFit::view}) {
        Light light;
        const dmat4 turn = glm::rotate(dmat4(1.0), 0.4, dvec3(0, 1, 0));
        light.world_from_light = glm::rotate(turn, -elevation * pi / 180.0, dvec3(1, 0, 0));
        MapFitParams fit;
        fit.fit = area;
        fit.selection = selection;
        const SeenPart seen{gbuffer, camera_at()};
        const MapLayout alone = fit_map(light, scene, {64, 2}, seen, fit);
        const MapLayout layout = fit_map(light, {scene, ground}, {64, 2}, seen, fit);
        ASSERT_EQ(layout.views.size(), alone.views.size());
        for (std::size_t v = 0; v < layout.views.size(); ++v) {
          EXPECT_EQ(layout.views[v].half_extent, alone.views[v].half_extent);
          EXPECT_EQ(layout.views[v].center, alone.views[v].center);
        }
        int inside = 0;
        for (int i = 0; i <= 32; ++i) {
          for (int k = 0; k <= 32; ++k) {
            const dvec3 place(-8.0 + 0.5 * i, 0, -8.0 + 0.5 * k);
            EXPECT_EQ(is_inside(layout, place), is_inside(alone, place));
            if (!is_inside(layout, place)) continue;
            ++inside;
            EXPECT_GT(depth_of(layout, place), 0.0) << elevation;
            EXPECT_LT(depth_of(layout, place), layout.far_depth) << elevation;
          }
        }
        EXPECT_GT(inside, 0);
        for (int i = 0; i < 8; ++i) {
          EXPECT_GT(depth_of(layout, scene.corner(i)), 0.0);
          EXPECT_LT(depth_of(layout, scene.corner(i)), layout.far_depth);
        }
      }
    }
  }
  Light lamp;
  lamp.shape = PointLight{};
  EXPECT_GT(fit_map(lamp, {scene, ground}, {64, 1}, {gbuffer}).far_depth, 8.0 * std::sqrt(2.0));
}

TEST(Cascades, An_empty_range_and_a_light_without_cascades_are_errors) {
  MapFitParams fit = stable_fit(MapFit::scene);
  fit.max_distance = 1.0;
  EXPECT_THROW(fit_map(sun(), scene_bounds(), {512, 2}, {row_of_surfels(), camera_at()}, fit), Error);
  Light lamp;
  lamp.shape = PointLight{};
  const Light lamps[] = {lamp};
  const Light both[] = {lamp, sun()};
  EXPECT_THROW(require_sense({512, 2}, {}, lamps), Error);
  EXPECT_THROW(require_sense({512, 1}, fit, lamps), Error);
  EXPECT_NO_THROW(require_sense({512, 1}, {}, lamps));
  EXPECT_NO_THROW(require_sense({512, 2}, fit, both));
}

}  // namespace
}  // namespace umbrameter
