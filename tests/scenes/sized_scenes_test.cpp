// Built-in scenes that come in any size.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/error.h"
#include "scenes/builtin.h"
#include "tests/support/text.h"

namespace umbrameter {
namespace {

struct Sized {
  const char* text;
  double triangles;
};

TEST(SizedScenes, Have_the_asked_number_of_triangles_within_a_tenth) {
  constexpr std::array<Sized, 12> asked{{{"forest:1e5", 1e5},
                                         {"forest:137k", 137e3},
                                         {"forest:300k", 3e5},
                                         {"forest:2M", 2e6},
                                         {"forest:2e7", 2e7},
                                         {"forest:100000000", 1e8},
                                         {"city:1e4", 1e4},
                                         {"city:12345", 12345},
                                         {"city:70k", 7e4},
                                         {"city:.3M", 3e5},
                                         {"city:2.5e6", 2.5e6},
                                         {"city:5M", 5e6}}};
  for (const Sized& size : asked) {
    const SceneCounts counts = count(load_scene(size.text));
    EXPECT_NEAR(static_cast<double>(counts.triangles) / size.triangles, 1.0, 0.1) << size.text;
  }
}

TEST(SizedScenes, Have_their_own_size_when_none_is_asked_for) {
  for (const BuiltinScene& scene : builtin_scenes()) {
    if (scene.counted != "triangles") continue;
    EXPECT_LE(scene.fewest, scene.preset) << scene.name;
    EXPECT_GE(scene.most, scene.preset) << scene.name;
    const double have = static_cast<double>(count(load_scene(std::string(scene.name))).triangles);
    EXPECT_NEAR(have / static_cast<double>(scene.preset), 1.0, 0.1) << scene.name;
  }
}

TEST(SizedScenes, The_forest_shares_its_meshes_and_shows_neighbours_of_one_mesh_together) {
  const Scene scene = load_scene("forest:20M");
  EXPECT_LT(count(scene).stored_triangles, 300000u);
  EXPECT_LT(scene.instances.size(), 200000u);
  std::size_t runs = 1;
  for (std::size_t i = 1; i < scene.instances.size(); ++i) {
    if (scene.instances[i].mesh != scene.instances[i - 1].mesh) ++runs;
  }
  EXPECT_EQ(runs, scene.meshes.size());
}

TEST(SizedScenes, The_city_shares_nothing) {
  for (const char* text : {"city:50k", "city:1M"}) {
    const SceneCounts counts = count(load_scene(text));
    EXPECT_EQ(counts.stored_triangles, counts.triangles) << text;
  }
}

std::string usage_failure_of(const std::string& name) {
  try {
    load_scene(name);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage) << error.what();
    EXPECT_FALSE(contains(error.what(), "\n")) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "'" << name << "' was loaded";
  return {};
}

TEST(SizedScenes, Sizes_that_are_no_number_are_errors_that_say_how_to_write_one) {
  for (const char* size :
       {"", "big", "-1e6", "0", "nan", "inf", "1e6x", "1MM", "20 M", "0x10000", "+1e6", "1e400", "k"}) {
    const std::string text = usage_failure_of(std::string("forest:") + size);
    EXPECT_TRUE(contains(text, "forest:300k")) << text;
  }
}

TEST(SizedScenes, Sizes_beyond_the_limits_are_errors_that_give_them) {
  EXPECT_TRUE(contains(usage_failure_of("forest:99999"), "100000 to 100000000"));
  EXPECT_TRUE(contains(usage_failure_of("forest:101M"), "100000 to 100000000"));
  EXPECT_TRUE(contains(usage_failure_of("city:9k"), "10000 to 20000000"));
  EXPECT_TRUE(contains(usage_failure_of("city:1e9"), "10000 to 20000000"));
}

// Whether a light's range and cone contain a point.
bool reaches(const Light& light, const dvec3& point) {
  const dvec3 offset = point - light.position();
  if (const auto* spot = std::get_if<SpotLight>(&light.shape)) {
    return glm::length(offset) < spot->range &&
           glm::dot(glm::normalize(offset), light.axis()) > std::cos(spot->outer_cone_angle);
  }
  return glm::length(offset) < std::get<PointLight>(light.shape).range;
}

TEST(SizedScenes, The_courtyard_can_have_small_lights_in_place_of_its_own) {
  for (const int number : {1, 64, 1024}) {
    const Scene scene = load_scene("courtyard:" + std::to_string(number));
    ASSERT_EQ(scene.lights.size(), static_cast<std::size_t>(number));
    int spots = 0;
    for (const Light& light : scene.lights) {
      const auto* spot = std::get_if<SpotLight>(&light.shape);
      const double range = spot != nullptr ? spot->range : std::get<PointLight>(light.shape).range;
      EXPECT_GE(range, 1.5) << light.name;
      EXPECT_LE(range, 4.0) << light.name;
      if (spot == nullptr) continue;
      ++spots;
      EXPECT_LT(spot->inner_cone_angle, spot->outer_cone_angle) << light.name;
      EXPECT_GE(spot->outer_cone_angle, 15.0 * pi / 180.0 - 1e-12) << light.name;
      EXPECT_LE(spot->outer_cone_angle, 40.0 * pi / 180.0 + 1e-12) << light.name;
    }
    EXPECT_EQ(spots, number / 2);
    EXPECT_EQ(count(scene).triangles, count(load_scene("courtyard")).triangles);
  }
}

TEST(SizedScenes, The_first_two_small_lights_of_the_courtyard_contain_its_cameras) {
  const Scene scene = load_scene("courtyard:2");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(reaches(scene.lights[i], dvec3(scene.cameras[i].world_from_camera[3]))) << i;
  }
}

TEST(SizedScenes, Numbers_of_lights_beyond_the_limits_are_errors_that_give_them) {
  EXPECT_TRUE(contains(usage_failure_of("courtyard:1M"), "1 to 1024 lights"));
  EXPECT_TRUE(contains(usage_failure_of("courtyard:many"), "courtyard:64"));
}

TEST(SizedScenes, A_size_for_a_scene_of_one_size_is_an_error) {
  EXPECT_TRUE(contains(usage_failure_of("room:1M"), "one size"));
}

}  // namespace
}  // namespace umbrameter
