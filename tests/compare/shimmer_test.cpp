#include "compare/shimmer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flat_ground.h"
#include "techniques/shadow/reference/lookup.h"

namespace umbrameter {
namespace {

Bounds box(double half_side) {
  Bounds bounds;
  bounds.include(dvec3(-half_side));
  bounds.include(dvec3(half_side));
  return bounds;
}

TEST(Shimmer, An_orthographic_grid_moves_by_the_texels_asked_for) {
  const FlatGround ground(4, 4, 1.0, dvec3(-1, 2, 0.5), 0.25);
  const MapLayout shifted = shift_grid(ground.layout, {0.25, -0.5}, box(1.0));
  for (const dvec3 place : {dvec3(0), dvec3(3, 1, -2)}) {
    const Receiver before = project_to_map(ground.layout, place);
    const Receiver after = project_to_map(shifted, place);
    EXPECT_NEAR(after.texels.x - before.texels.x, 0.25, 1e-9);
    EXPECT_NEAR(after.texels.y - before.texels.y, -0.5, 1e-9);
    EXPECT_NEAR(after.depth, before.depth, 1e-12);
  }
}

TEST(Shimmer, A_perspective_grid_moves_so_in_its_middle) {
  MapLayout layout;
  layout.kind = MapKind::perspective;
  layout.resolution = 512;
  layout.views.front().half_extent = 0.7;
  const Receiver after = project_to_map(shift_grid(layout, {0.5, 0.25}, box(1.0)), dvec3(0, 0, -3));
  EXPECT_NEAR(after.texels.x, 256.5, 1e-3);
  EXPECT_NEAR(after.texels.y, 256.25, 1e-3);
  EXPECT_NEAR(after.depth, 3.0, 1e-5);
}

TEST(Shimmer, A_cubes_grid_moves_on_every_face) {
  MapLayout layout;
  layout.kind = MapKind::cube;
  layout.resolution = 512;
  const MapLayout shifted = shift_grid(layout, {0.5, 0.5}, box(1.0));
  for (int face = 0; face < 6; ++face) {
    const dvec3 place = 2.0 * cube_face(face)[2];
    const dvec2 before = project_to_map(layout, place).texels;
    const dvec2 after = project_to_map(shifted, place).texels;
    EXPECT_NEAR(std::abs(after.x - before.x), 0.5, 1e-2) << face;
    EXPECT_NEAR(std::abs(after.y - before.y), 0.5, 1e-2) << face;
  }
}

TEST(Shimmer, A_paraboloids_grid_moves_in_the_middle_of_both_views) {
  MapLayout layout;
  layout.kind = MapKind::paraboloid;
  layout.resolution = 512;
  layout.views.assign(2, MapView{});
  const MapLayout shifted = shift_grid(layout, {0.5, 0.25}, {});
  for (const dvec3& place : {dvec3(0, 0, -2), dvec3(0, 0, 2)}) {
    const dvec2 moved = glm::abs(project_to_map(shifted, place).texels - 256.0);
    EXPECT_NEAR(moved.x, 0.5, 1e-3);
    EXPECT_NEAR(moved.y, 0.25, 1e-3);
  }
}

// A spot of 70° half opening at the origin, 3 m above a floor of 18 m: half a texel of 64 is 0.043 rad, by which the
// floor's corners, 9 m off the axis both ways, become deeper by up to 0.77 m.
TEST(Shimmer, Every_surface_stays_nearer_than_the_far_depth_of_a_shifted_map) {
  Bounds bounds;
  bounds.include(dvec3(-9, -9, -3));
  bounds.include(dvec3(9, 9, -2));
  Light light;
  for (const MapKind kind : {MapKind::orthographic, MapKind::perspective, MapKind::cube}) {
    if (kind == MapKind::perspective) light.shape = SpotLight{0.0, 0.0, 70.0 * pi / 180.0};
    if (kind == MapKind::cube) light.shape = PointLight{};
    const MapLayout layout = fit_light(light, bounds, 64);
    ASSERT_EQ(layout.kind, kind);
    for (const dvec2 texels : {dvec2(0.5, 0.5), dvec2(-0.5, 0.5), dvec2(0.5, -0.5), dvec2(-0.5, -0.5)}) {
      const MapLayout shifted = shift_grid(layout, texels, bounds);
      for (int i = 0; i < 8; ++i) EXPECT_LT(depth_of(shifted, bounds.corner(i)), shifted.far_depth);
      if (layout.kind != MapKind::perspective) {
        EXPECT_EQ(shifted.far_depth, layout.far_depth);
      }
    }
  }
}

TEST(Shimmer, A_shifted_view_sees_what_lay_beside) {
  View view{640, 480, {}};
  view.camera.projection = OrthographicProjection{4.0, 3.0, 0.0, 100.0};
  const dvec3 right = pixel_ray(view, 101, 50).origin - pixel_ray(view, 100, 50).origin;
  const dvec3 down = pixel_ray(view, 100, 51).origin - pixel_ray(view, 100, 50).origin;
  const dvec3 moved = pixel_ray(shift_view(view, {0.5, 0.25}), 100, 50).origin - pixel_ray(view, 100, 50).origin;
  EXPECT_NEAR(glm::distance(moved, 0.5 * right + 0.25 * down), 0.0, 1e-12);

  view.camera.projection = PerspectiveProjection{0.9, 0.01, 100.0};
  const dvec3 one = pixel_ray(shift_view(view, {1.0, 1.0}), 320, 240).direction;
  EXPECT_NEAR(glm::distance(one, pixel_ray(view, 321, 241).direction), 0.0, 1e-5);
}

TEST(Shimmer, Flips_are_the_mean_change_of_the_counted_pixels_on_one_triangle) {
  FlatGround ground(4, 1, 1.0, dvec3(0, 1, 0), 1.0);
  Image<float> before(4, 1, 1.0f);
  Image<float> after = before;
  after.pixels = {0.0f, 0.5f, 1.0f, 0.0f};
  ground.counted.exclusion[3] = PixelExclusion::back_facing;
  EXPECT_EQ(count_flips(before, after, ground.counted).pixels, 3u);
  EXPECT_DOUBLE_EQ(count_flips(before, after, ground.counted).share, 0.5);
  GBuffer other = ground.gbuffer;
  other.triangle[0] = 7;
  const Flips same = count_flips(before, after, ground.counted, ground.gbuffer, other);
  EXPECT_EQ(same.pixels, 2u);
  EXPECT_DOUBLE_EQ(same.share, 0.25);
  ground.counted.exclusion = Image<PixelExclusion>(4, 1, PixelExclusion::background);
  EXPECT_EQ(count_flips(before, after, ground.counted).share, 0.0);
}

}  // namespace
}  // namespace umbrameter
