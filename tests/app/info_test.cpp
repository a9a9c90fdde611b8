// The scene as `info` reports it, as text and as JSON, and which scene of a file is read.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/run_program.h"
#include "tests/scenes/gltf_files.h"
#include "tests/support/expect_words.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

// The triangle (0,0,0) (1,0,0) (0,1,0) in two scenes: as it is, and 30,000 times as large.
test::Bytes two_scenes() {
  return test::glb(
      test::triangle_json(
          R"("nodes":[{"mesh":0},{"mesh":0,"scale":[30000,30000,30000]}],"scene":0)",
          R"("scenes":[{"name":"small","nodes":[0]},{"name":"large","nodes":[1]},{"name":"both","nodes":[0,1]}])"),
      test::triangle_positions());
}

Json info(const std::vector<std::string>& words) {
  std::vector<std::string> arguments{"info", "--json"};
  arguments.insert(arguments.end(), words.begin(), words.end());
  const ProgramResult result = run_program(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return Json::parse(result.out)["scene"];
}

std::string info_text(const std::string& scene) {
  const ProgramResult result = run_program({"info", scene});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  return result.out;
}

std::string error_of(const std::vector<std::string>& words, int exit_code) {
  const ProgramResult result = run_program(words);
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  return result.err;
}

TEST(Info, A_missing_library_of_OpenGL_means_no_device_and_is_named_by_what_needs_one) {
  const TemporaryFolder folder;
  const ProgramOptions options{{"LD_LIBRARY_PATH=" + folder.path().string()}, {}, 0, 0.0};
  const auto expect_missing = [&](const std::string& library) {
    const ProgramResult result = run_program({"info"}, options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("no usable device"), std::string::npos) << result.out;
    const ProgramResult drawn = run_program({"raster", "corner", "-o", folder / "out", "--quiet"}, options);
    EXPECT_EQ(drawn.exit_code, 3);
    EXPECT_TRUE(is_one_line(drawn.err)) << drawn.err;
    EXPECT_NE(drawn.err.find(library + " cannot be loaded"), std::string::npos) << drawn.err;
  };
  // A file that is no library hides that of the system.
  for (const char* hidden : {"libOpenGL.so.0", "libGL.so.1"}) folder.write(hidden, "no library");
  expect_missing("libGL.so.1");
  folder.write("libEGL.so.1", "no library");
  expect_missing("libEGL.so.1");
}

TEST(Info, A_driver_that_is_offered_in_several_ways_has_one_line) {
  std::istringstream lines(run_program({"info"}).out);
  std::vector<std::string> drivers;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("OpenGL") || line.find(": ") == std::string::npos) continue;
    drivers.push_back(line.substr(line.find(": ")));
  }
  for (const std::string& each : drivers) EXPECT_EQ(std::count(drivers.begin(), drivers.end(), each), 1) << each;
}

TEST(Info, The_scene_flag_chooses_by_name_or_index_and_the_default_is_the_files_own) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.glb", two_scenes()).string();
  EXPECT_EQ(info({file})["triangles"], 1);
  EXPECT_EQ(info({file, "--scene", "both"})["triangles"], 2);
  EXPECT_EQ(info({file, "--scene", "2"})["triangles"], 2);
  EXPECT_EQ(info({file, "--scene", "large"})["extent_m"], (Json{30000.0, 30000.0, 0.0}));
  EXPECT_EQ(info({file, "--scene", "large"})["scene"], "large");
}

TEST(Info, A_scene_that_is_not_there_is_a_usage_error_that_lists_those_that_are) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.glb", two_scenes()).string();
  expect_words(error_of({"info", file, "--scene", "huge"}, 2), {"--scene huge", "small", "large", "both"});
  expect_words(error_of({"trace", file, "--scene", "7", "-o", folder / "out"}, 2), {"--scene 7", "small"});
  expect_words(error_of({"info", "corner", "--scene", "0"}, 2), {"--scene 0", "'corner' is a built-in scene"});
  expect_words(error_of({"scene", "corner", "--scene", "0", "-o", folder / "c.glb"}, 2), {"--scene 0"});
  expect_words(error_of({"info", "--scene", "0"}, 2), {"--scene 0", "no file"});
}

TEST(Info, Memory_limits_what_a_file_may_take_for_every_command_that_loads_one) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.glb", two_scenes()).string();
  EXPECT_EQ(info({file, "--memory", "1G"})["triangles"], 1);
  for (const std::vector<std::string>& command : {std::vector<std::string>{"info", file},
                                                  {"scene", file, "-o", folder / "copy.glb"},
                                                  {"trace", file, "-o", folder / "out"}}) {
    std::vector<std::string> words = command;
    words.insert(words.end(), {"--memory", "1K"});
    expect_words(error_of(words, 4), {"two.glb", "--memory"});
  }
  expect_words(error_of({"info", file, "--memory", "lots"}, 2), {"--memory lots", "512M"});
}

TEST(Info, A_run_stores_the_scene_that_it_was_about_and_repeats_it) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.glb", two_scenes()).string();
  ASSERT_EQ(run_program(
                {"trace", file, "--scene", "both", "-o", folder / "a", "--size", "16x9", "--truth.spp", "1", "--quiet"})
                .exit_code,
            0);
  EXPECT_NE(text_of(folder / "a/experiment.toml").find("scene = \"both\""), std::string::npos)
      << text_of(folder / "a/experiment.toml");
  ASSERT_EQ(run_program({"trace", "-c", folder / "a/experiment.toml", "-o", folder / "b", "--quiet"}).exit_code, 0);
  const Json summary = Json::parse(text_of(folder / "b/summary.json"));
  EXPECT_EQ(summary["scene"]["triangles"], 2);
  EXPECT_EQ(summary["parameters"]["view.scene"], "both");
}

TEST(Info, A_sweep_is_about_one_scene) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.glb", two_scenes()).string();
  expect_words(error_of({"sweep", file, "-o", folder / "out", "--vary", "view.scene=small,large"}, 2),
               {"view.scene", "one scene"});
}

TEST(Info, A_scene_of_30000_m_is_told_to_be_in_millimetres) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.glb", two_scenes()).string();
  const Json units = info({file, "--scene", "large"})["units"];
  EXPECT_EQ(units["assumed"], "m");
  EXPECT_EQ(units["verdict"], "implausible");
  EXPECT_EQ(units["likely"], "mm");
  EXPECT_EQ(units["candidates"][0]["scale_to_m"], 0.001);
  EXPECT_EQ(info({file})["units"]["verdict"], "credible");
  const ProgramResult text = run_program({"info", file, "--scene", "large"});
  expect_words(text.out, {"the size is implausible: it is longer than 20 km", "30 m in mm", "--scene.unit mm"});
}

TEST(Info, Text_tells_cameras_lights_materials_and_memory) {
  expect_words(info_text("courtyard"),
               {"overview", "vertical field of view 42°", "0.05 m to infinity", "sun", "directional", "lx",
                "half cone 14° to 24°", "cd", "range 12 m", "[-12, -0.4, -10] to [8.9, 8.37, 8.6] m",
                "20.9 × 8.774 × 18.6 m", "opaque", "texture", "computed", "measured", "more (--json lists all)"});
}

TEST(Info, A_masked_material_is_told_with_its_cutoff) {
  const TemporaryFolder folder;
  std::string json =
      test::triangle_json(R"("nodes":[{"mesh":0}])",
                          R"("materials":[{"name":"leaf","alphaMode":"MASK","alphaCutoff":0.25,"doubleSided":true}])");
  const std::string attributes = R"("attributes":{"POSITION":0})";
  json.insert(json.find(attributes), R"("material":0,)");
  const std::string file = folder.write("leaf.glb", test::glb(json, test::triangle_positions())).string();
  expect_words(info_text(file), {"leaf  mask, alpha >= 0.25  no texture  double-sided"});
  const Json material = info({file})["materials"][0];
  EXPECT_EQ(material["alpha_mode"], "mask");
  EXPECT_EQ(material["alpha_cutoff"], 0.25);
  EXPECT_EQ(material["double_sided"], true);
}

TEST(Info, Text_stays_within_100_columns_and_tells_each_name_as_plain_text) {
  const TemporaryFolder folder;
  const std::string name = "light \\u001b[31m" + std::string(300, 'x');
  const std::string file =
      folder
          .write("loud.glb",
                 test::glb(test::triangle_json(
                               R"("nodes":[{"mesh":0},{"extensions":{"KHR_lights_punctual":{"light":0}}}])",
                               R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":)"
                               R"({"lights":[{"type":"point","name":")" +
                                   name + R"("}]}})"),
                           test::triangle_positions()))
          .string();
  for (const std::string& scene : {std::string("courtyard"), std::string("tilted-plane"), file}) {
    std::istringstream lines(info_text(scene));
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("scene ", 0) == 0) continue;  // holds the path
      const auto characters = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
      EXPECT_LE(characters, 100) << line;
      EXPECT_EQ(line.find('\x1b'), std::string::npos) << line;
    }
  }
}

TEST(Info, Json_lists_everything_with_its_units) {
  const Json scene = info({"courtyard"});
  const Json& camera = scene["cameras"][0];
  EXPECT_EQ(camera["name"], "overview");
  EXPECT_NEAR(camera["vertical_fov_deg"].get<double>(), 42.0, 1e-9);
  EXPECT_TRUE(camera["far_m"].is_null());
  const Json& spot = scene["lights"][2];
  EXPECT_EQ(spot["intensity_unit"], "cd");
  EXPECT_NEAR(spot["outer_cone_deg"].get<double>(), 24.0, 1e-9);
  EXPECT_EQ(scene["lights"][0]["intensity_unit"], "lx");
  EXPECT_GT(scene["materials"].size(), 12u);
  EXPECT_EQ(scene["textures"][2]["width"], 256);
  EXPECT_EQ(scene["textures"][2]["bytes"], 256 * 192 * 4);
  const Json& memory = scene["memory"];
  EXPECT_EQ(memory["scene"]["known"], "computed");
  EXPECT_EQ(memory["scene"]["indices"], scene["stored_triangles"].get<int>() * 12);  // three 32-bit indices
  EXPECT_EQ(memory["tracer"]["known"], "measured");
  EXPECT_GT(memory["tracer"]["total"].get<double>(), 0.0);
  EXPECT_GT(memory["load"]["peak_resident"].get<double>(), memory["scene"]["total"].get<double>());
}

TEST(Info, Every_key_of_the_json_is_on_the_page_that_explains_them) {
  const std::string page = text_of(std::string(UMBRAMETER_DOCS) + "/info.md");
  const std::function<void(const Json&)> look = [&](const Json& json) {
    if (json.is_object()) {
      for (const auto& [key, value] : json.items()) {
        EXPECT_NE(page.find("`" + key + "`"), std::string::npos) << key;
        look(value);
      }
    }
    if (json.is_array()) {
      for (const Json& value : json) look(value);
    }
  };
  const TemporaryFolder folder;
  look(info({"courtyard"}));
  look(info({folder.write("two.glb", two_scenes()).string(), "--scene", "large"}));
  look(info({"tilted-plane"}));
}

}  // namespace
}  // namespace umbrameter
