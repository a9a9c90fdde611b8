// The list of built-in scenes, its page and the contact sheet.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/run_program.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

ProgramResult draw(const std::string& file, const std::vector<std::string>& more = {"corner", "contact-box"}) {
  std::vector<std::string> words{"scenes", "--sheet", file, "--size", "32x20"};
  words.insert(words.end(), more.begin(), more.end());
  return run_program(words);
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Scenes, The_list_tells_purpose_size_cameras_and_lights) {
  const ProgramResult result = run_program({"scenes", "contact-box"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  // Nine boxes and the slab that they stand on: ten times twelve triangles.
  for (const char* words : {"contact-box", "bias detaches their shadows", "120 triangles",
                            "cameras overview, front-row", "lights sun, sun-across"}) {
    EXPECT_NE(result.out.find(words), std::string::npos) << words << " in: " << result.out;
  }
}

TEST(Scenes, The_json_says_the_same) {
  const ProgramResult result = run_program({"scenes", "contact-box", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json scene = Json::parse(result.out)[0];
  EXPECT_EQ(scene["name"], "contact-box");
  EXPECT_EQ(scene["triangles"], 120);
  EXPECT_TRUE(scene["sizes"].is_null());
  EXPECT_EQ(scene["cameras"][0], "overview");
  EXPECT_EQ(scene["lights"][0], "sun");
}

TEST(Scenes, A_scene_with_a_size_says_which_and_takes_it) {
  const ProgramResult usual = run_program({"scenes", "city"});
  EXPECT_NE(usual.out.find("city:NUMBER for "), std::string::npos) << usual.out;
  const ProgramResult result = run_program({"scenes", "city:50k", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json scene = Json::parse(result.out)[0];
  EXPECT_EQ(scene["name"], "city:50k");
  EXPECT_NEAR(scene["triangles"].get<double>(), 50e3, 0.2 * 50e3);
  EXPECT_LE(scene["sizes"][0].get<double>(), 50e3);
  const TemporaryFolder folder;
  ASSERT_EQ(run_program({"scene", "city:50k", "-o", folder / "city.glb"}).exit_code, 0);
  const Json written = Json::parse(run_program({"info", folder / "city.glb", "--json"}).out);
  EXPECT_EQ(written["scene"]["triangles"], scene["triangles"]);
}

TEST(Scenes, The_page_is_what_the_program_lists) {
  const ProgramResult result = run_program({"scenes", "--markdown"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, text_of(std::string(UMBRAMETER_DOCS) + "/scenes.md"))
      << "run: umbrameter scenes --markdown > docs/scenes.md";
}

TEST(Scenes, A_sheet_holds_a_picture_a_name_and_a_purpose_for_each_scene_asked_for) {
  const TemporaryFolder folder;
  const ProgramResult result = draw(folder / "sheet.svg");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const std::string svg = text_of(folder / "sheet.svg");
  EXPECT_EQ(count_of(svg, "<image "), 2u);
  EXPECT_EQ(count_of(svg, ">corner</text>"), 1u);
  EXPECT_EQ(count_of(svg, ">contact-box</text>"), 1u);
  EXPECT_EQ(count_of(svg, ">120 triangles</text>"), 1u);
  EXPECT_LT(svg.find(">corner<"), svg.find(">contact-box<")) << "in the order asked for";
}

TEST(Scenes, A_sheet_is_byte_identical_at_any_number_of_threads) {
  const TemporaryFolder folder;
  ASSERT_EQ(draw(folder / "one.svg", {"corner", "--threads", "1"}).exit_code, 0);
  ASSERT_EQ(draw(folder / "two.svg", {"corner", "--threads", "2"}).exit_code, 0);
  EXPECT_EQ(text_of(folder / "one.svg"), text_of(folder / "two.svg"));
}

TEST(Scenes, The_files_name_says_what_kind_it_is) {
  const TemporaryFolder folder;
  ASSERT_EQ(draw(folder / "sheet.png", {"corner"}).exit_code, 0);
  ASSERT_EQ(draw(folder / "sheet.pdf", {"corner"}).exit_code, 0);
  EXPECT_EQ(text_of(folder / "sheet.png").substr(1, 3), "PNG");
  EXPECT_EQ(text_of(folder / "sheet.pdf").substr(0, 5), "%PDF-");
  const ProgramResult other = draw(folder / "sheet.doc", {"corner"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("sheet.doc"), std::string::npos) << other.err;
  EXPECT_EQ(count_files(folder.path()), 2u) << "nothing half-written stays";
}

TEST(Scenes, What_cannot_be_drawn_is_a_usage_error) {
  const TemporaryFolder folder;
  const auto expect_usage = [](const ProgramResult& result, const std::string& words) {
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  };
  expect_usage(draw(folder / "sheet.svg", {"cornor"}), "cornor");
  expect_usage(run_program({"scenes", "--sheet", folder / "a.svg", "--size", "0x4"}), "0x4");
  expect_usage(run_program({"scenes", "--size", "64x40"}), "--sheet");
  EXPECT_EQ(count_files(folder.path()), 0u);
}

}  // namespace
}  // namespace umbrameter
