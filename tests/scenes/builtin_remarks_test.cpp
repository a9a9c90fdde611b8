// What is noted of doubtful scenes and cameras is not noted of built-in ones.
#include <gtest/gtest.h>

#include <cctype>
#include <string>
#include <vector>

#include "scenes/builtin.h"
#include "scenes/fitted_camera.h"

namespace umbrameter {
namespace {

class EachScene : public testing::TestWithParam<std::string_view> {};

TEST_P(EachScene, It_is_loaded_as_it_is_made_without_a_remark) {
  const Scene scene = load_scene(std::string(GetParam()));
  EXPECT_EQ(scene.origin, dvec3(0));
  EXPECT_TRUE(scene.notes.empty()) << scene.notes.front();
}

TEST_P(EachScene, None_of_its_cameras_is_inside_an_object) {
  const Scene scene = load_scene(std::string(GetParam()));
  for (const Camera& camera : scene.cameras) {
    EXPECT_EQ(camera_remark(scene, camera, 16.0 / 9.0), "") << camera.name;
  }
}

std::vector<std::string_view> names() {
  std::vector<std::string_view> all;
  for (const BuiltinScene& scene : builtin_scenes()) all.push_back(scene.name);
  all.insert(all.end(), {"courtyard:64", "city:10k", "city:1M", "forest:100k"});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Builtin, EachScene, testing::ValuesIn(names()), [](const auto& tested) {
  std::string name(tested.param);
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
});

TEST(Room, Without_its_cameras_it_is_seen_from_inside) {
  Scene scene = load_scene("room");
  scene.cameras.clear();
  const Camera camera = fit_camera(scene, 16.0 / 9.0).camera;
  const dvec3 eye(camera.world_from_camera[3]);
  // The room's inside: 5.2 m × 2.8 m × 4.2 m from the origin.
  EXPECT_TRUE(eye.x > 0 && eye.x < 5.2 && eye.y > 0 && eye.y < 2.8 && eye.z > 0 && eye.z < 4.2)
      << eye.x << " " << eye.y << " " << eye.z;
  EXPECT_EQ(camera_remark(scene, camera, 16.0 / 9.0), "");
}

}  // namespace
}  // namespace umbrameter
