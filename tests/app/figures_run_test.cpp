// That a run need not draw its figures. The reference alone: no driver is needed.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/run_program.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> trace_into(const fs::path& folder) {
  return {"trace", "corner", "-o", folder.string(), "--size", "64x36", "--light", "sun", "--truth.spp", "4"};
}

TEST(FiguresOfARun, Can_be_left_out_and_the_page_says_so) {
  const TemporaryFolder folder;
  std::vector<std::string> words = trace_into(folder / "out");
  words.emplace_back("--no-figures");
  const ProgramResult result = run_program(words);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("AO"), std::string::npos) << result.out;
  EXPECT_FALSE(fs::exists(folder / "out/figures"));
  const std::string page = text_of(folder / "out/index.html");
  EXPECT_NE(page.find("no pictures: the run used --no-figures"), std::string::npos);
  for (const char* picture : {"<figure", "<svg", "<img"}) EXPECT_EQ(page.find(picture), std::string::npos) << picture;
  const nlohmann::json summary = nlohmann::json::parse(text_of(folder / "out/summary.json"));
  ASSERT_FALSE(summary["files"].empty());
  for (const std::string file : summary["files"]) EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;
}

TEST(FiguresOfARun, Do_not_change_the_numbers) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(trace_into(folder / "with")).exit_code, 0);
  std::vector<std::string> words = trace_into(folder / "without");
  words.emplace_back("--no-figures");
  ASSERT_EQ(run_program(words).exit_code, 0);
  EXPECT_TRUE(text_of(folder / "with/images.exr") == text_of(folder / "without/images.exr"));
}

}  // namespace
}  // namespace umbrameter
