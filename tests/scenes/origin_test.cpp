#include "scenes/origin.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/builtin.h"
#include "tests/scenes/gltf_files.h"

namespace umbrameter {
namespace {

// A box of 4 m on a floor of 12 m, with a camera and a lamp, all of them `place` away by the instances' transforms.
Scene box_at(const dvec3& place) {
  Scene scene;
  scene.materials.resize(1);
  scene.objects = {{"floor"}, {"box"}};
  scene.meshes.push_back(
      {"floor", {{-6, 0, -6}, {6, 0, -6}, {6, 0, 6}, {-6, 0, 6}}, {}, {}, {{0, 2, 1}, {0, 3, 2}}, 0});
  scene.meshes.push_back({"box", {{-2, 0, -2}, {2, 0, -2}, {2, 4, 2}, {-2, 4, 2}}, {}, {}, {{0, 2, 1}, {0, 3, 2}}, 0});
  dmat4 there(1.0);
  there[3] = dvec4(place, 1.0);
  scene.instances = {{0, 0, there}, {1, 1, there}};
  dmat4 eye = there;
  eye[3] += dvec4(1, 2, 3, 0);
  scene.cameras.push_back({"eye", eye, PerspectiveProjection{}});
  scene.lights.push_back({"lamp", eye, vec3(1), 10.0, PointLight{}});
  return scene;
}

void expect_same_places(const Scene& scene, const Scene& expected, double tolerance) {
  ASSERT_EQ(scene.instances.size(), expected.instances.size());
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    for (std::uint32_t t = 0; t < 2; ++t) {
      const Triangle a = world_triangle(scene, i, t);
      const Triangle b = world_triangle(expected, i, t);
      EXPECT_LE(glm::distance(a.a, b.a), tolerance);
      EXPECT_LE(glm::distance(a.b, b.b), tolerance);
      EXPECT_LE(glm::distance(a.c, b.c), tolerance);
    }
  }
  EXPECT_LE(glm::distance(dvec3(scene.cameras[0].world_from_camera[3]), dvec3(1, 2, 3)), tolerance);
  EXPECT_LE(glm::distance(scene.lights[0].position(), dvec3(1, 2, 3)), tolerance);
}

TEST(Origin, A_box_far_away_by_its_transforms_comes_back_exactly) {
  const Scene near_scene = box_at(dvec3(0));
  for (const dvec3& place : {dvec3(1e6, 0, 0), dvec3(-1e6, 0, 1e9), dvec3(3e5, 2e4, -7e7)}) {
    Scene scene = box_at(place);
    move_to_centre(scene);
    // Whole metres away, all of it is exact in double precision.
    expect_same_places(scene, near_scene, 0.0);
    EXPECT_EQ(scene.origin, place);
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_NE(scene.notes[0].find("it was moved"), std::string::npos) << scene.notes[0];
  }
}

TEST(Origin, A_place_between_two_numbers_comes_back_to_within_their_distance) {
  const dvec3 place(1e9 + 0.1, 0.3, 0);
  Scene scene = box_at(place);
  move_to_centre(scene);
  // Double-precision numbers near 10^9 are 2^-23 apart.
  EXPECT_LE(std::abs(scene.origin.x + scene.instances[0].world_from_mesh[3].x - (1e9 + 0.1)), 0x1p-23);
  EXPECT_LE(bounds_of(scene).radius(), 8.9);
  EXPECT_LT(glm::length(bounds_of(scene).center() - dvec3(0, 2.3, 0)), 1.0);
}

TEST(Origin, A_scene_within_64_radii_keeps_every_bit) {
  // A floor of 12 m and a box of 4 m have a radius of 8.7 m.
  const Scene before = box_at({500, -300, 0.1});
  Scene scene = before;
  move_to_centre(scene);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(scene.instances[i].world_from_mesh, before.instances[i].world_from_mesh);
    EXPECT_EQ(scene.meshes[i].positions, before.meshes[i].positions);
  }
  EXPECT_EQ(scene.origin, dvec3(0));
  EXPECT_TRUE(scene.notes.empty());
}

TEST(Origin, Along_an_axis_on_which_the_scene_is_near_nothing_moves) {
  Scene scene = box_at({1e6, 5.25, 0});
  move_to_centre(scene);
  EXPECT_EQ(scene.origin, dvec3(1e6, 0, 0));
  EXPECT_EQ(scene.instances[0].world_from_mesh[3].y, 5.25);
}

// The same vertices, stored in single precision far away.
Scene box_of_far_vertices(float far) {
  Scene scene = box_at(dvec3(0));
  for (Mesh& mesh : scene.meshes) {
    for (vec3& position : mesh.positions) position.x += far;
  }
  return scene;
}

TEST(Origin, Vertices_far_away_move_to_their_mesh_and_the_note_says_in_which_steps_they_were) {
  Scene scene = box_of_far_vertices(1e6f);
  scene.cameras.clear();
  scene.lights.clear();
  move_to_centre(scene);
  EXPECT_EQ(scene.origin, dvec3(1e6, 0, 0));
  for (const Mesh& mesh : scene.meshes) {
    for (const vec3& position : mesh.positions) EXPECT_LE(std::abs(position.x), 12.0f);
  }
  const Bounds bounds = bounds_of(scene);
  EXPECT_NEAR(bounds.min.x, -6.0, 1e-12);  // whole metres are exact
  EXPECT_NEAR(bounds.max.x, 6.0, 1e-12);
  ASSERT_EQ(scene.notes.size(), 2u);
  // Single-precision numbers from 2^19 to 2^20 are 2^-4 = 0.0625 apart.
  EXPECT_NE(scene.notes[1].find("steps of 0.06 m"), std::string::npos) << scene.notes[1];
}

TEST(Origin, Vertices_that_a_transform_brings_back_are_moved_as_well) {
  Scene scene = box_of_far_vertices(1e6f);
  for (Instance& instance : scene.instances) instance.world_from_mesh[3].x = -1e6;
  move_to_centre(scene);
  EXPECT_EQ(scene.origin, dvec3(0));
  expect_same_places(scene, box_at(dvec3(0)), 0.0);
  for (const Mesh& mesh : scene.meshes) {
    for (const vec3& position : mesh.positions) EXPECT_LE(std::abs(position.x), 12.0f);
  }
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_NE(scene.notes[0].find("steps of 0.06 m"), std::string::npos) << scene.notes[0];
}

TEST(Origin, Turned_and_scaled_instances_of_a_far_mesh_stay_where_they_are) {
  Scene scene = box_of_far_vertices(1e6f);
  dmat4 turned(0.0);
  turned[0] = {0, 0, -2, 0};
  turned[1] = {0, 2, 0, 0};
  turned[2] = {2, 0, 0, 0};
  turned[3] = {1, 2, 2e6, 1};
  scene.instances = {{0, 0, turned}, {1, 1, turned}};
  const Triangle before = world_triangle(scene, 1, 0);
  move_to_centre(scene);
  const Triangle after = world_triangle(scene, 1, 0);
  EXPECT_EQ(scene.origin, dvec3(0));
  EXPECT_LE(glm::distance(before.a, after.a), 1e-9);
  EXPECT_LE(glm::distance(before.c, after.c), 1e-9);
}

TEST(Origin, Without_triangles_nothing_happens) {
  Scene scene;
  move_to_centre(scene);
  EXPECT_EQ(scene.origin, dvec3(0));
  EXPECT_TRUE(scene.notes.empty());
}

TEST(Origin, A_file_is_moved_when_it_is_loaded) {
  const TemporaryFolder folder;
  const std::string json = test::triangle_json(R"("nodes":[{"mesh":0,"translation":[1e9,0,0]}])");
  const Scene scene = load_scene(folder.write("far.glb", test::glb(json, test::triangle_positions())).string());
  EXPECT_NEAR(scene.origin.x, 1e9, 1.0);
  EXPECT_EQ(scene.origin + bounds_of(scene).min, dvec3(1e9, 0, 0));
  EXPECT_EQ(bounds_of(scene).extent(), dvec3(1, 1, 0));
}

}  // namespace
}  // namespace umbrameter
