// Shaded images: what compare, sweep, trace and raster make of them, and which inputs they refuse.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

struct Shading : GlRun {
  ProgramResult run(const std::vector<std::string>& command, const std::string& name = "out") {
    return run_program(words(words(command, {"-o", folder_ / name}), small));
  }
  Json summary(const std::string& name = "out") { return Json::parse(text_of(folder_ / name / "summary.json")); }
};

TEST_F(Shading, Compare_reports_the_error_by_input_and_writes_both_images) {
  const ProgramResult result =
      run({"compare", "courtyard", "--measure", "image", "--shadow.resolution", "256", "--no-figures"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("image: error "), std::string::npos) << result.out;
  EXPECT_NE(
      result.out.find(
          "with one input of the reference in place of the technique's it falls by, in per cent of white: shadows "),
      std::string::npos)
      << result.out;
  const Json statistics = summary()["image"]["statistics"];
  EXPECT_GT(statistics["mae"], 0.001);
  EXPECT_LT(statistics["mae_off_edges"], statistics["mae"]);
  EXPECT_GT(statistics["shadows"], 0.0005);
  EXPECT_GT(statistics["ao"], 0.0005);
  EXPECT_EQ(statistics["gbuffer"], 0.0);
  EXPECT_NEAR(statistics["shading"], 0.0, 1e-6);
  EXPECT_LE(statistics["mae_lo"], statistics["mae"]);
  const std::set<std::string> channels = channel_names(folder_ / "out/images.exr");
  for (const char* name :
       {"truth_image.R", "raster_image.B", "truth_image_standard_error.Y", "error_image.Y", "cause_image.Y"}) {
    EXPECT_EQ(channels.count(name), 1u) << name;
  }
}

TEST_F(Shading, A_float_gbuffer_loses_nothing_and_each_format_costs_more_than_the_better_one) {
  const ProgramResult result =
      run({"sweep", "courtyard", "--shading.path", "deferred", "--shading.position", "stored", "--shading.color-format",
           "rgba32f", "--vary", "shading.normal-format=rgb32f,rg16,rgb8", "--light", "sun", "--no-figures"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream rows(text_of(folder_ / "out/sweep.csv"));
  std::string header;
  std::getline(rows, header);
  std::vector<std::string> names;
  std::istringstream columns(header);
  for (std::string name; std::getline(columns, name, ',');) names.push_back(name);
  const auto of_image = std::find(names.begin(), names.end(), "gbuffer_image") - names.begin();
  ASSERT_LT(static_cast<std::size_t>(of_image), names.size()) << header;
  std::vector<double> losses;
  for (std::string line; std::getline(rows, line);) {
    std::istringstream cells(line);
    std::string cell;
    for (std::ptrdiff_t c = 0; c <= of_image; ++c) std::getline(cells, cell, ',');
    losses.push_back(std::stod(cell));
  }
  ASSERT_EQ(losses.size(), 3u);
  EXPECT_LT(losses[0], 1e-9);  // the processor's roughness is read back from the stored shininess
  EXPECT_GT(losses[1], 0.0);
  EXPECT_GT(losses[2], 10 * losses[1]);
}

TEST_F(Shading, An_area_light_gives_the_traced_image_a_standard_error) {
  const ProgramResult result =
      run({"trace", "contact-box", "--measure", "image", "--light.angle", "2", "--no-figures"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const LayeredImage image = read_exr(folder_ / "out/images.exr");
  float largest = 0.0f;
  for (const Channel& channel : image.channels) {
    if (channel.name != "truth_image_standard_error.Y") continue;
    for (const float value : channel.values.pixels) largest = std::max(largest, value);
  }
  EXPECT_GT(largest, 0.01f);
  EXPECT_LT(largest, 0.5f);
}

TEST_F(Shading, Overlays_become_figures_and_light_volumes_are_counted) {
  const ProgramResult result = run({"raster", "courtyard:4", "--shading.path", "deferred", "--overlay",
                                    "normal,light-buffer,shadow-map:0,light-view:1", "--shadow.resolution", "256"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* stem : {"overlay", "view_normal", "view_light_buffer", "raster_image"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out/figures" / (std::string(stem) + ".png"))) << stem;
  }
  const Json volumes = summary()["image"]["light_volumes"];
  ASSERT_EQ(volumes.size(), 4u);
  std::int64_t shaded = 0;
  for (const Json& volume : volumes) shaded += volume["shaded_px"].get<std::int64_t>();
  EXPECT_GT(shaded, 0);
}

TEST_F(Shading, What_makes_no_sense_is_one_line_and_leaves_nothing) {
  struct Case {
    std::vector<std::string> command;
    std::string message;
  };
  const std::vector<Case> cases = {
      {{"raster", "courtyard", "--overlay", "normals"}, "there is no such view; did you mean 'normal'"},
      {{"raster", "courtyard", "--overlay", "light-buffer"}, "the forward path has no light buffer"},
      {{"raster", "courtyard", "--overlay", "shadow-map:moon"}, "no such light"},
      {{"trace", "courtyard", "--overlay", "normal"}, "trace draws none of these views"},
      {{"sweep", "courtyard", "--vary", "shading.ambient=0,1", "--overlay", "normal"}, "a sweep draws no views"},
      {{"sweep", "courtyard", "--vary", "shading.normal-format=rg16,rgb8"}, "shading.path forward does not read it"},
  };
  for (const Case& c : cases) {
    const ProgramResult result = run(c.command);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find(c.message), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }
}

TEST_F(Shading, The_deferred_path_refuses_transparent_materials_unless_told_what_they_are) {
  const auto file = folder_ / "glass.gltf";
  std::ofstream(file) << R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "materials": [{"name": "glass", "alphaMode": "BLEND"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  const std::vector<std::string> command = {"raster", file.string(),    "--measure",
                                            "image",  "--shading.path", "deferred"};
  const ProgramResult refused = run(command);
  EXPECT_EQ(refused.exit_code, 2) << refused.err;
  EXPECT_NE(refused.err.find("the material 'glass' is transparent"), std::string::npos) << refused.err;
  EXPECT_EQ(run(words(command, {"--scene.blend", "mask", "--no-figures"})).exit_code, 0);
}

}  // namespace
}  // namespace umbrameter
