// Presets of lamps, drawn: a bias in the depth of a cube, for example, is refused only then.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

struct Presets : GlRun {};

TEST_F(Presets, Those_of_spot_and_point_lights_draw_the_map_of_such_a_light) {
  const ProgramResult listed = run_program({"presets", "--json"});
  ASSERT_EQ(listed.exit_code, 0) << listed.err;
  int drawn = 0;
  for (const nlohmann::json& preset : nlohmann::json::parse(listed.out)) {
    const std::string kind = preset.at("kind");
    if (kind != "spot" && kind != "point") continue;
    const std::string name = preset.at("name");
    const ProgramResult run =
        run_program({"raster", "courtyard", "--light", kind == "spot" ? "spot" : "lantern", "--size", "16x9",
                     "--measure", "visibility", "--preset", name, "--no-figures", "--quiet", "-o", folder_ / name});
    EXPECT_EQ(run.exit_code, 0) << name << ": " << run.err;
    ++drawn;
  }
  EXPECT_GE(drawn, 16);
}

}  // namespace
}  // namespace umbrameter
