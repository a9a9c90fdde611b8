#include "scenes/floor.h"

#include <gtest/gtest.h>

#include "scenes/builtin.h"
#include "scenes/builtin/shapes.h"

namespace umbrameter {
namespace {

Scene scene_of(const std::vector<Mesh>& meshes) {
  Scene scene;
  scene.materials.resize(1);
  scene.objects.resize(1);
  scene.meshes = meshes;
  for (std::uint32_t m = 0; m < meshes.size(); ++m) scene.instances.push_back({m, 0, dmat4(1.0)});
  return scene;
}

// A body on four legs, 1 m long and 0.7 m high, as one mesh.
builtin::Shape animal() {
  builtin::Shape shape = builtin::box({-0.5, 0.4, -0.15}, {0.5, 0.7, 0.15});
  for (const double x : {-0.45, 0.35}) {
    for (const double z : {-0.15, 0.05}) builtin::append(shape, builtin::box({x, 0.0, z}, {x + 0.1, 0.4, z + 0.1}));
  }
  return shape;
}

Mesh plane(float half, float height, bool turned = false) {
  Mesh mesh;
  mesh.positions = {{-half, height, -half}, {-half, height, half}, {half, height, half}, {half, height, -half}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  if (turned) mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
  return mesh;
}

TEST(Floor, An_object_by_itself_has_none) {
  EXPECT_FALSE(has_floor(Scene{}));
  EXPECT_FALSE(has_floor(scene_of({to_mesh("animal", animal(), 0)})));
  EXPECT_FALSE(has_floor(scene_of({to_mesh("ball", builtin::sphere(1.0, 32), 0)})));
  EXPECT_FALSE(has_floor(scene_of({to_mesh("box", builtin::box({0, 0, 0}, {1, 1, 1}), 0)})));
}

// The top of the crate is in the lower half of the height and covers the whole plan.
TEST(Floor, The_top_of_a_crate_is_none) {
  builtin::Shape crate = builtin::box({0.0, 0.0, 0.0}, {1.0, 0.4, 1.0});
  builtin::append(crate, builtin::box({0.45, 0.4, 0.45}, {0.55, 2.0, 0.55}));
  EXPECT_FALSE(has_floor(scene_of({to_mesh("crate with a pole", crate, 0)})));
  EXPECT_TRUE(has_floor(scene_of({to_mesh("crate with a pole", crate, 0), plane(2.0f, 0.0f)})));
}

TEST(Floor, A_plane_or_slab_under_it_is_one_also_in_the_same_mesh) {
  EXPECT_TRUE(has_floor(scene_of({to_mesh("animal", animal(), 0), plane(2.0f, 0.0f)})));
  builtin::Shape merged = animal();
  builtin::append(merged, builtin::box({-1.0, -0.1, -1.0}, {1.0, 0.0, 1.0}));
  EXPECT_TRUE(has_floor(scene_of({to_mesh("animal on a slab", merged, 0)})));
}

TEST(Floor, Faces_up) {
  EXPECT_FALSE(has_floor(scene_of({to_mesh("animal", animal(), 0), plane(2.0f, 0.0f, true)})));
  // A mirror turns the order of the vertices round, but not the surface.
  Scene mirrored = scene_of({to_mesh("animal", animal(), 0), plane(2.0f, 0.0f)});
  mirrored.instances[1].world_from_mesh[0][0] = -1.0;
  EXPECT_TRUE(has_floor(mirrored));
}

TEST(Floor, A_roof_is_none) { EXPECT_FALSE(has_floor(scene_of({to_mesh("animal", animal(), 0), plane(2.0f, 3.0f)}))); }

TEST(Floor, Every_built_in_scene_has_one) {
  for (const BuiltinScene& each : builtin_scenes()) EXPECT_TRUE(has_floor(make(each))) << each.name;
}

}  // namespace
}  // namespace umbrameter
