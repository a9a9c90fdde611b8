// The flags scene.* with each command that reads a scene.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/run_program.h"
#include "tests/scenes/gltf_files.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

// The triangle (0,0,0) (1,0,0) (0,1,0), scaled; its material may be blended.
std::string write_triangle(const TemporaryFolder& folder, double size, bool is_blended = false) {
  const std::string scale = std::to_string(size);
  std::string json = test::triangle_json(R"("nodes":[{"mesh":0,"scale":[)" + scale + "," + scale + "," + scale + "]}]",
                                         R"("materials":[{"name":"glass","alphaMode":"BLEND"}])");
  if (is_blended) {
    const std::string attributes = R"("attributes":{"POSITION":0})";
    json.insert(json.find(attributes), R"("material":0,)");
  }
  return folder.write("triangle.glb", test::glb(json, test::triangle_positions())).string();
}

Json info_of(std::vector<std::string> words) {
  words.insert(words.begin(), {"info", "--json"});
  const ProgramResult result = run_program(words);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return Json::parse(result.out)["scene"];
}

std::string usage_error(const std::vector<std::string>& words) {
  const ProgramResult result = run_program(words);
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  return result.err;
}

void expect_all_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
}

TEST(SceneFlags, Info_and_scene_read_the_file_in_the_given_unit) {
  const TemporaryFolder folder;
  const std::string file = write_triangle(folder, 300);
  EXPECT_DOUBLE_EQ(info_of({file})["extent_m"][0], 300.0);
  EXPECT_DOUBLE_EQ(info_of({file, "--scene.unit", "cm"})["extent_m"][0], 3.0);
  EXPECT_DOUBLE_EQ(info_of({"corner", "--scene.unit", "0.5"})["extent_m"][0].get<double>(),
                   0.5 * info_of({"corner"})["extent_m"][0].get<double>());
  const ProgramResult written = run_program({"scene", file, "--scene.unit", "cm", "-o", folder / "written.glb"});
  EXPECT_EQ(written.exit_code, 0) << written.err;
  EXPECT_DOUBLE_EQ(info_of({folder / "written.glb"})["extent_m"][0], 3.0);
}

TEST(SceneFlags, A_run_stores_them_and_repeats_them) {
  const TemporaryFolder folder;
  const std::string file = write_triangle(folder, 300);
  const std::vector<std::string> rest = {"--size", "16x9", "--truth.spp", "1", "--quiet"};
  std::vector<std::string> first = {"trace", file, "-o", folder / "a", "--scene.unit", "cm", "--scene.blend", "mask"};
  first.insert(first.end(), rest.begin(), rest.end());
  ASSERT_EQ(run_program(first).exit_code, 0);
  expect_all_words(text_of(folder / "a/experiment.toml"),
                   {"[scene]\nsource = \"" + file + "\"", "unit = \"cm\"", "blend = \"mask\""});
  ASSERT_EQ(run_program({"trace", "-c", folder / "a/experiment.toml", "-o", folder / "b", "--quiet"}).exit_code, 0);
  EXPECT_EQ(text_of(folder / "a/images.exr"), text_of(folder / "b/images.exr"));
  const Json summary = Json::parse(text_of(folder / "b/summary.json"));
  EXPECT_EQ(summary["parameters"]["scene.unit"], "cm");
  EXPECT_EQ(summary["parameters"]["scene.blend"], "mask");
}

TEST(SceneFlags, A_sweep_cannot_vary_them) {
  const TemporaryFolder folder;
  const std::string file = write_triangle(folder, 1);
  for (const std::string axis : {"scene.unit=m,cm", "scene.blend=opaque,mask", "scene.ground=false,true"}) {
    expect_all_words(usage_error({"sweep", file, "-o", folder / "out", "--vary", axis}),
                     {"--vary " + axis.substr(0, axis.find('=')), "one scene"});
  }
}

TEST(SceneFlags, A_ground_is_named_with_its_size_and_belongs_to_the_settings_of_a_run) {
  const TemporaryFolder folder;
  const std::string file = write_triangle(folder, 3);
  // The diagonal is 3 √2 m = 4.24 m; five of them are 21.2 m.
  const std::string said = "a ground of 21.2 m x 21.2 m, 5 times the scene's diagonal";
  for (const std::vector<std::string>& flag :
       {std::vector<std::string>{"--scene.ground"}, {"--scene.ground", "true"}}) {
    std::vector<std::string> words = {"trace", file, "--size", "16x9", "--truth.spp", "1", "--force"};
    words.insert(words.end(), flag.begin(), flag.end());
    words.insert(words.end(), {"-o", folder / "out"});
    const ProgramResult traced = run_program(words);
    ASSERT_EQ(traced.exit_code, 0) << traced.err;
    expect_all_words(traced.err, {said});
    expect_all_words(text_of(folder / "out/experiment.toml"), {"ground = true"});
    expect_all_words(text_of(folder / "out/index.html"), {"a ground of 21.2 m"});
  }
  const Json with = info_of({file, "--scene.ground"});
  EXPECT_EQ(with["extent_m"], info_of({file})["extent_m"]);
  EXPECT_EQ(with["triangles"], 3);
  expect_all_words(usage_error({"info", "--scene.ground", file}), {"scene.ground", "triangle.glb"});
}

TEST(SceneFlags, What_makes_no_sense_is_a_usage_error) {
  const TemporaryFolder folder;
  expect_all_words(usage_error({"info", "corner", "--scene.unit", "furlong"}), {"--scene.unit furlong", "inch"});
  expect_all_words(usage_error({"trace", "corner", "--scene.unit", "-1", "-o", folder / "out"}), {"--scene.unit -1"});
  expect_all_words(usage_error({"info", "corner", "--scene.blend", "glass"}), {"scene.blend", "leave-out"});
  expect_all_words(usage_error({"info", "--scene.unit", "cm"}), {"--scene.unit cm", "no file"});
}

TEST(SceneFlags, Each_command_says_what_is_taken_as_opaque) {
  const TemporaryFolder folder;
  const std::string file = write_triangle(folder, 1, true);
  const std::string said = "1 triangle of the material 'glass'";
  const ProgramResult traced = run_program({"trace", file, "-o", folder / "out", "--size", "16x9", "--truth.spp", "1"});
  ASSERT_EQ(traced.exit_code, 0) << traced.err;
  expect_all_words(traced.err, {said, "--scene.blend"});
  expect_all_words(text_of(folder / "out/summary.json"), {said});
  expect_all_words(text_of(folder / "out/index.html"), {"1 triangle of the material"});
  expect_all_words(run_program({"info", file}).out, {"1 triangle of the material"});
  expect_all_words(run_program({"scene", file, "-o", folder / "copy.glb"}).err, {said});
}

}  // namespace
}  // namespace umbrameter
