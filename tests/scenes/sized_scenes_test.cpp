// Built-in scenes that come in any size.
#include <gtest/gtest.h>

#include <array>

#include "core/error.h"
#include "scenes/builtin.h"

namespace umbrameter {
namespace {

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

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
    if (scene.triangles == 0) continue;
    EXPECT_LE(scene.fewest, scene.triangles) << scene.name;
    EXPECT_GE(scene.most, scene.triangles) << scene.name;
    const double have = static_cast<double>(count(load_scene(std::string(scene.name))).triangles);
    EXPECT_NEAR(have / static_cast<double>(scene.triangles), 1.0, 0.1) << scene.name;
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

TEST(SizedScenes, A_size_for_a_scene_of_one_size_is_an_error) {
  EXPECT_TRUE(contains(usage_failure_of("courtyard:1M"), "one size"));
}

}  // namespace
}  // namespace umbrameter
