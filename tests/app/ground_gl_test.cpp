// --scene.ground in runs that draw.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scenes/builtin.h"
#include "scenes/gltf.h"
#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

struct GroundRun : GlRun {
  // One cube of contact-box, without its floor.
  std::string box_file() {
    Scene scene = load_scene("contact-box");
    std::erase_if(scene.instances,
                  [&](const Instance& instance) { return scene.objects[instance.object].name != "gap 0"; });
    const std::vector<unsigned char> glb = to_glb(scene);
    return folder_.write("box.glb", glb).string();
  }
  // The sun in a compare of it.
  Json shadow(const std::vector<std::string>& more) {
    const ProgramResult result = run_program(words(
        words({"compare", box_file(), "-o", folder_ / "out", "--force", "--light", "0", "--no-figures"}, more), small));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return Json::parse(text_of(folder_ / "out/summary.json"))["shadows"][0];
  }
};

// A convex body casts no shadow on itself, so that no bias removes one.
TEST_F(GroundRun, Gives_a_lone_box_a_shadow_that_a_large_bias_removes) {
  const std::vector<std::string> large = {"--shadow.constant-bias", "10"};  // metres, longer than the shadow
  const Json alone = shadow(large);
  EXPECT_GT(alone["statistics"]["pixels"], 0);
  EXPECT_EQ(alone["statistics"]["blocked"], 0.0);
  EXPECT_EQ(alone["statistics"]["mae"], 0.0);
  const Json above = shadow(words(large, {"--scene.ground"}));
  const double blocked = above["statistics"]["blocked"];
  EXPECT_GT(blocked, 0.01);
  // All of it is lost.
  EXPECT_NEAR(above["statistics"]["mae"], blocked, 1e-12);
  EXPECT_GT(above["statistics"]["peter_panning"], 0.9 * blocked);
  // The map has the same area, so that its texels are as large.
  EXPECT_NEAR(above["map"]["mean_texel_m"], alone["map"]["mean_texel_m"], 1e-9);
}

TEST_F(GroundRun, A_sweep_and_a_tuning_of_a_lone_box_recommend_no_bias) {
  for (const char* command : {"sweep", "tune"}) {
    const std::string axis = "shadow.constant-bias=0texels:40texels" + std::string(command[0] == 's' ? ":41" : "");
    const ProgramResult result = run_program(
        words({command, box_file(), "-o", folder_ / command, "--light", "0", "--no-figures", "--vary", axis},
              {"--size", "96x54"}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out.find("no bias recommended: "), 0u) << result.out;
  }
  const Json curve = Json::parse(text_of(folder_ / "sweep/summary.json"))["curves"]["biases"][0];
  EXPECT_TRUE(curve["recommended"].is_null());
}

}  // namespace
}  // namespace umbrameter
