// `umbrameter convert` as a program. Maps are laid out from traced surfels: no OpenGL.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/run_program.h"
#include "tests/scenes/gltf_files.h"
#include "tests/support/expect_words.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

ProgramResult convert(const std::vector<std::string>& words) {
  std::vector<std::string> arguments{"convert", "--size", "160x90"};
  arguments.insert(arguments.end(), words.begin(), words.end());
  return run_program(arguments);
}

Json converted(std::vector<std::string> words) {
  words.emplace_back("--json");
  const ProgramResult result = convert(words);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return Json::parse(result.out);
}

// A file as another program writes it: 2 km of ground, a model of 10 cm before the camera, a sun 60° high.
test::Bytes large_and_small() {
  return test::glb(
      test::triangle_json(R"("nodes":[{"mesh":0,"name":"ground","scale":[2000,2000,2000],"translation":[-500,0,500],)"
                          R"("rotation":[-0.70710678,0,0,0.70710678]},{"mesh":0,"name":"model","scale":[0.1,0.1,0.1]},)"
                          R"({"camera":0,"translation":[0,0.3,1]},)"
                          R"({"rotation":[-0.5,0,0,0.8660254],"extensions":{"KHR_lights_punctual":{"light":0}}}])",
                          R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[)"
                          R"({"type":"directional","name":"sun"}]}},)"
                          R"("cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.05,"zfar":2000}}])"),
      test::triangle_positions());
}

// What the formulas of the sources give for this map, cascade by cascade.
void expect_formulas(const Json& json) {
  const Json& map = json["map"];
  for (std::size_t i = 0; i < map.size(); ++i) {
    const double t = map[i]["texel_m"];
    const double range = map[i]["range_m"];
    const double metres = 0.1 / 100 * (t * 1024 + 20) * 2;  // Godot: R = t · 1024 + 20 m, quality low 2
    EXPECT_NEAR(map[i]["bias_m"], metres, 1e-9 * metres);
    const Json& to = json["to"];
    EXPECT_NEAR(to[0]["numbers"][0]["values"][i], -metres / 79, 1e-9);                   // three.js, 1 to 80 m
    EXPECT_NEAR(to[1]["numbers"][0]["values"][i], metres / t / 2.5, 1e-9 * metres / t);  // URP, medium
    EXPECT_NEAR(to[2]["numbers"][0]["values"][i], metres, 1e-9 * metres);
    EXPECT_NEAR(to[3]["numbers"][0]["values"][i], metres / t, 1e-9 * metres / t);
    EXPECT_NEAR(to[4]["numbers"][0]["values"][i], metres / range, 1e-9);
  }
}

const std::vector<std::string> godot_to_five = {"--light",
                                                "sun",
                                                "--shadow.cascades",
                                                "4",
                                                "--shadow.resolution",
                                                "1024",
                                                "--from",
                                                "godot:bias=0.1,normal_bias=2",
                                                "--to",
                                                "three:near=1,far=80,unity-urp:soft=medium,metres,texels",
                                                "--to",
                                                "map-depth"};

TEST(Convert, Each_cascade_of_a_built_in_scene_follows_the_formulas) {
  std::vector<std::string> words{"courtyard"};
  words.insert(words.end(), godot_to_five.begin(), godot_to_five.end());
  const Json json = converted(words);
  ASSERT_EQ(json["map"].size(), 4u);
  EXPECT_LT(json["map"][0]["texel_m"], json["map"][3]["texel_m"]);
  expect_formulas(json);
  EXPECT_TRUE(json["to"][0]["numbers"][1]["values"][0].is_null());
  EXPECT_NE(json["to"][0]["numbers"][1]["reason"].get<std::string>().find(
                "includes the component along the light's direction"),
            std::string::npos);
}

TEST(Convert, Each_cascade_of_a_foreign_file_follows_the_formulas) {
  const TemporaryFolder folder;
  std::vector<std::string> words{folder.write("large.glb", large_and_small()).string()};
  words.insert(words.end(), godot_to_five.begin(), godot_to_five.end());
  const Json json = converted(words);
  ASSERT_EQ(json["map"].size(), 4u);
  // From centimetres near the camera to the metres of 2 km on 1022 texels.
  EXPECT_LT(json["map"][0]["texel_m"], 0.5);
  EXPECT_GT(json["map"][3]["texel_m"], 1.0);
  expect_formulas(json);
}

TEST(Convert, The_table_has_every_unit_and_the_code_of_each_engine) {
  const ProgramResult result = convert(
      {"courtyard", "--light", "sun", "--shadow.cascades", "2", "--from", "texels:2", "--to", "three,godot,unity-urp"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* word : {"t [m]", "R [m]", "bias [m]", "[texels]", "[of R]", "cascade 2",
                           "csm.lights[1].shadow.bias = -", "light.shadow_bias = ", "light.shadowBias = 2.0f;"}) {
    EXPECT_NE(result.out.find(word), std::string::npos) << word << " in: " << result.out;
  }
  for (const char* word : {"godot, not verified", "polygon offset factor 2.5"}) {
    EXPECT_NE(result.err.find(word), std::string::npos) << word << " in: " << result.err;
  }
}

TEST(Convert, Settings_are_named_where_they_enter_the_formulas) {
  const auto header = [](const char* light) {
    return convert({"courtyard", "--light", light, "--from", "texels:2", "--to", "godot"}).out;
  };
  EXPECT_NE(header("sun").find("Godot 4, blur = 1, quality = low or medium (factor 2), pancake = 20 m, rounded up:"),
            std::string::npos)
      << header("sun");
  EXPECT_NE(header("lantern").find("Godot 4, rounded up:"), std::string::npos) << header("lantern");
}

TEST(Convert, Second_hand_formulas_say_so) {
  const ProgramResult result = convert({"courtyard", "--light", "sun", "--from", "metres:0.05", "--to", "unreal"});
  EXPECT_NE(result.err.find("unreal, not verified: the formula and the default Shadow Bias of 0.5 are from copies"),
            std::string::npos)
      << result.err;
}

TEST(Convert, A_number_below_the_inspectors_step_and_one_beyond_its_limits_are_noted) {
  const ProgramResult small = convert({"courtyard", "--light", "sun", "--from", "metres:0.0001", "--to", "godot"});
  EXPECT_NE(small.err.find("step of 0.001"), std::string::npos) << small.err;
  const ProgramResult large = convert({"courtyard", "--light", "sun", "--from", "metres:9", "--to", "filament"});
  EXPECT_NE(large.err.find("outside its limits 0 to 2"), std::string::npos) << large.err;
  EXPECT_NE(large.out.find("options.constantBias = 2.0f;  // its limit; the bias would need 9.0"), std::string::npos)
      << large.out;
}

TEST(Convert, A_bias_that_a_target_cannot_say_is_lost_with_a_word) {
  const ProgramResult result = convert({"courtyard", "--light", "sun", "--from", "metres:0.05", "--to", "playcanvas"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("// no setting for the constant bias: it is lost"), std::string::npos) << result.out;
  const ProgramResult all = convert({"courtyard", "--light", "sun", "--from", "metres:0.05"});
  EXPECT_NE(all.err.find("no part of this bias has an equivalent in: playcanvas, unity-hdrp"), std::string::npos)
      << all.err;
}

TEST(Convert, The_metres_of_one_unit_have_their_sign_and_their_place) {
  const ProgramResult sun = convert({"courtyard", "--light", "sun", "--from", "three:bias=-0.001,near=1,far=51"});
  EXPECT_NE(sun.out.find("one unit of bias is −50.0 m; formula: "), std::string::npos) << sun.out;
  const ProgramResult lamp =
      convert({"courtyard", "--light", "spot", "--from", "three:bias=-0.001,near=0.01,far=500", "--to", "metres"});
  EXPECT_NE(lamp.out.find(" m at the nearest receiver, −"), std::string::npos) << lamp.out;
  EXPECT_NE(lamp.out.find(" m at the farthest receiver; formula: "), std::string::npos) << lamp.out;
  EXPECT_NE(lamp.err.find("are found among the pixels of a 160x90 image"), std::string::npos) << lamp.err;
  EXPECT_EQ(sun.err.find("among the pixels"), std::string::npos) << sun.err;
}

TEST(Convert, An_offset_of_casters_has_its_own_name_and_defaults_say_that_they_are) {
  const ProgramResult result =
      convert({"courtyard", "--light", "sun", "--from", "unity-urp:shadowBias=2", "--to", "umbrameter"});
  EXPECT_NE(result.out.find("umbrameter  caster-offset"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("shadowNormalBias = 1, its default (unit: texels × (1 − cos θ))"), std::string::npos)
      << result.out;
}

TEST(Convert, Notes_about_lamps_are_for_lamps) {
  const auto notes = [](const char* light) {
    return convert({"courtyard", "--light", light, "--from", "metres:0.05", "--to", "bevy,godot"}).err;
  };
  EXPECT_EQ(notes("sun").find("point light"), std::string::npos) << notes("sun");
  EXPECT_NE(notes("lantern").find("godot: a point light's shadow_normal_bias"), std::string::npos) << notes("lantern");
}

TEST(Convert, A_point_light_has_the_defaults_of_point_lights) {
  const auto from = [](const char* light, const char* bias) {
    const ProgramResult result = convert({"courtyard", "--light", light, "--from", bias, "--to", "three,metres"});
    return result.out;
  };
  const std::string lantern = from("lantern", "bevy");
  expect_words(
      lantern,
      {"shadow_depth_bias = 0.08, its default (unit: m); shadow_normal_bias = 0.6, its default (unit: √2 texels)",
       "// bias: no number everywhere: the nearest receiver of this image is "});
  expect_words(from("spot", "bevy"), {"shadow_depth_bias = 0.02, its default (unit: m)"});
  expect_words(from("lantern", "bevy:shadow_depth_bias=0.02"), {"shadow_depth_bias = 0.02 (unit: m); "});
}

TEST(Convert, A_lamp_has_its_nearest_and_its_farthest_receiver) {
  const Json json = converted({"courtyard", "--light", "spot", "--from", "metres:0.02", "--to", "three,bevy"});
  ASSERT_EQ(json["map"].size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const double d = json["map"][i]["depth_m"];
    EXPECT_NEAR(json["to"][0]["numbers"][0]["values"][i], -0.02 / (d * d * 499.5 / 250), 1e-9);
  }
  EXPECT_LT(json["map"][0]["depth_m"], json["map"][1]["depth_m"]);
}

TEST(Convert, A_warped_map_has_its_finest_and_its_coarsest_receiver_and_one_setting_for_both) {
  const std::vector<std::string> words{"courtyard", "--light",       "sun",         "--shadow.fit",
                                       "view",      "--shadow.warp", "lispsm",      "--from",
                                       "texels:1",  "--to",          "three,metres"};
  const Json json = converted(words);
  ASSERT_EQ(json["map"].size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(json["to"][1]["numbers"][0]["values"][i], json["map"][i]["texel_m"]);
  EXPECT_LT(json["map"][0]["texel_m"], json["map"][1]["texel_m"]);
  EXPECT_EQ(convert(words).out.find("csm"), std::string::npos) << "it has no cascades";
}

TEST(Convert, A_mistake_is_one_line_and_exit_code_2) {
  const std::pair<std::vector<std::string>, std::vector<std::string>> cases[] = {
      {{"courtyard"}, {"--from", "no bias given"}},
      {{"courtyard", "--from", "godott:bias=1"}, {"did you mean 'godot'"}},
      {{"courtyard", "--from", "godot:bias=nan"}, {"'nan' is not a number"}},
      {{"courtyard", "--light", "sun", "--from", "metres:1", "--to", "trhee"}, {"did you mean 'three'"}},
      {{"--from", "metres:1"}, {"no scene given"}},
      {{"courtyard", "--light", "moon", "--from", "metres:1"}, {"moon"}},
      {{"courtyard", "--light", "sun", "--from", "map-depth:0.005,range=1/2/3"}, {"3 values", "1 place"}},
      {{"courtyard", "--from", "metres:1"}, {"lights, and each has its own map", "--light"}},
      {{"courtyard", "--light", "lantern", "--from", "three:-0.001"}, {"nearest receiver", "three:near=0."}},
  };
  for (const auto& [words, expected] : cases) {
    const ProgramResult result = convert(words);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    for (const std::string& word : expected) EXPECT_NE(result.err.find(word), std::string::npos) << result.err;
  }
}

TEST(Convert, The_page_has_the_tables_that_the_program_prints) {
  const ProgramResult result = run_program({"convert", "--markdown"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::ostringstream page;
  page << std::ifstream(UMBRAMETER_DOCS "/convert.md").rdbuf();
  EXPECT_NE(page.str().find(result.out), std::string::npos)
      << "replace the tables at the end of docs/convert.md by the output of 'umbrameter convert --markdown'";
}

}  // namespace
}  // namespace umbrameter
