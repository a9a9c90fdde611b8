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
  // The first light of a compare of the box of contact-box alone, without its floor.
  Json shadow(const std::vector<std::string>& more) {
    Scene scene = load_scene("contact-box");
    std::erase_if(scene.instances,
                  [&](const Instance& instance) { return scene.objects[instance.object].name != "box"; });
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
  const std::vector<std::string> large = {"--shadow.constant-bias", "10"};
  const Json alone = shadow(large);
  EXPECT_EQ(alone["peter_panning"], 0.0);
  const Json above_ground = shadow(words(large, {"--scene.ground"}));
  EXPECT_GT(above_ground["peter_panning"], 0.01);
  EXPECT_EQ(above_ground["truth_mean"].get<double>() + above_ground["mae"].get<double>(), 1.0);
  // The map has the same area, so that its texels are as large.
  EXPECT_EQ(above_ground["map"]["texel_m"], alone["map"]["texel_m"]);
}

}  // namespace
}  // namespace umbrameter
