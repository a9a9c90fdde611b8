#include "scenes/ground.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/builtin.h"
#include "scenes/fitted_camera.h"
#include "scenes/gltf.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

// A box of 2 m × 4 m × 4 m whose diagonal is 6 m; its lowest point is at y = 3 m.
Scene make_box() {
  Scene scene;
  scene.materials.resize(1);
  scene.objects.push_back({"box"});
  Mesh box{"box",
           {},
           {},
           {},
           {{0, 4, 6},
            {0, 6, 2},
            {1, 3, 7},
            {1, 7, 5},
            {0, 1, 5},
            {0, 5, 4},
            {2, 6, 7},
            {2, 7, 3},
            {0, 2, 3},
            {0, 3, 1},
            {4, 5, 7},
            {4, 7, 6}},
           0};
  for (int i = 0; i < 8; ++i) {
    box.positions.emplace_back((i & 1) != 0 ? 11 : 9, (i & 2) != 0 ? 7 : 3, (i & 4) != 0 ? 2 : -2);
  }
  scene.meshes.push_back(box);
  scene.instances.push_back({0, 0, dmat4(1.0)});
  return scene;
}

Scene with_ground() {
  Scene scene = make_box();
  add_ground(scene);
  return scene;
}

TEST(Ground, Is_a_square_of_five_diagonals_that_faces_up_below_the_middle_of_the_scene) {
  const Scene scene = with_ground();
  ASSERT_TRUE(scene.ground);
  const Bounds ground = ground_of(scene);
  // 5 · 6 m = 30 m about x = 10 m and z = 0.
  EXPECT_EQ(ground.min, dvec3(-5, 3, -15));
  EXPECT_EQ(ground.max, dvec3(25, 3, 15));
  for (std::uint32_t t = 0; t < 2; ++t) {
    const Triangle corners = world_triangle(scene, *scene.ground, t);
    // Half of 30 m × 30 m each, counter-clockwise from above.
    EXPECT_EQ(glm::cross(corners.b - corners.a, corners.c - corners.a), dvec3(0, 900, 0));
  }
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_NE(scene.notes[0].find("30 m x 30 m, 5 times"), std::string::npos) << scene.notes[0];
}

TEST(Ground, Does_not_change_the_size_of_the_scene_nor_its_fitted_camera) {
  const Scene scene = with_ground();
  const Scene without = make_box();
  EXPECT_EQ(bounds_of(scene).min, bounds_of(without).min);
  EXPECT_EQ(bounds_of(scene).max, bounds_of(without).max);
  const FittedCamera fitted = fit_camera(scene, 1.5);
  EXPECT_EQ(fitted.camera.world_from_camera, fit_camera(without, 1.5).camera.world_from_camera);
  EXPECT_EQ(fitted.note, fit_camera(without, 1.5).note);
  EXPECT_TRUE(ground_of(without).empty());
}

TEST(Ground, Holds_the_whole_shadow_of_a_sun_27_degrees_above_the_horizon) {
  const Scene scene = with_ground();
  const Bounds box = bounds_of(scene);
  const Bounds ground = ground_of(scene);
  const double elevation = std::atan(0.5);
  for (int degrees = 0; degrees < 360; ++degrees) {
    const double azimuth = degrees * pi / 180.0;
    const dvec3 way(std::cos(elevation) * std::cos(azimuth), -std::sin(elevation),
                    std::cos(elevation) * std::sin(azimuth));
    for (int i = 0; i < 8; ++i) {
      const dvec3 corner = box.corner(i);
      const dvec3 shadow = corner + way * ((corner.y - ground.min.y) / -way.y);
      EXPECT_TRUE(shadow.x > ground.min.x && shadow.x < ground.max.x) << degrees;
      EXPECT_TRUE(shadow.z > ground.min.z && shadow.z < ground.max.z) << degrees;
    }
  }
}

TEST(Ground, A_scene_without_triangles_gets_none) {
  Scene scene;
  add_ground(scene);
  EXPECT_FALSE(scene.ground);
  EXPECT_TRUE(scene.notes.empty());
}

TEST(Ground, Is_added_in_metres_after_all_else) {
  const TemporaryFolder folder;
  const std::vector<unsigned char> glb = to_glb(make_box());
  const std::string file = folder.write("box.glb", glb).string();
  const Scene scene = load_scene(file, {}, {.unit = "0.5", .blend = BlendMode::opaque, .ground = true});
  EXPECT_NEAR(ground_of(scene).extent().x, 15.0, 1e-5);
  EXPECT_NEAR(ground_of(scene).min.y, 1.5, 1e-6);
  EXPECT_EQ(count(scene).triangles, 12u + 2u);
  EXPECT_FALSE(load_scene(file).ground);
}

}  // namespace
}  // namespace umbrameter
