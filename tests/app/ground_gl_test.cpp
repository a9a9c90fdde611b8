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
  // The sun in a compare of one cube of contact-box, without its floor.
  Json shadow(const std::vector<std::string>& more) {
    Scene scene = load_scene("contact-box");
    std::erase_if(scene.instances,
                  [&](const Instance& instance) { return scene.objects[instance.object].name != "gap 0"; });
    const std::vector<unsigned char> glb = to_glb(scene);
    const std::string file = folder_.write("box.glb", glb).string();
    const ProgramResult result = run_program(
        words(words({"compare", file, "-o", folder_ / "out", "--force", "--light", "0", "--no-figures"}, more), small));
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

}  // namespace
}  // namespace umbrameter
