// The error of ambient occlusion by stage in a whole run.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

struct AoStagesRun : GlRun {};

TEST_F(AoStagesRun, Compare_writes_stages_that_add_up_and_their_images) {
  const ProgramResult result = run_program(words(
      {"compare", "corner", "-o", folder_ / "out", "--light", "sun", "--ao-stages", "--ao.technique", "gtao", "--json"},
      small));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json summary = Json::parse(result.out);
  const Json& statistics = summary["ao"]["stages"]["statistics"];
  const std::set<std::string> channels = channel_names(folder_ / "out/images.exr");
  double sum = 0.0;
  for (const char* stage : {"model", "off_screen", "hidden", "thin", "approximation", "sampling", "blur"}) {
    sum += statistics[std::string(stage) + "_mean"].get<double>();
    EXPECT_TRUE(channels.contains("ao_stage_" + std::string(stage) + ".Y")) << stage;
  }
  EXPECT_NEAR(sum, summary["ao"]["statistics"]["mean_error"].get<double>(), 1e-6);

  // Header, all pixels, and 21 bins.
  std::ifstream csv(folder_ / "out/ao_stages.csv");
  std::size_t lines = 0;
  for (std::string line; std::getline(csv, line);) ++lines;
  EXPECT_EQ(lines, 23u);
  EXPECT_NE(summary["files"].dump().find("ao_stages.csv"), std::string::npos);
  expect_same_page_in_report(folder_ / "out", folder_ / "again", {"ao_stages.svg", "ao_stage_hidden.png"});
}

TEST_F(AoStagesRun, Without_the_flag_nothing_of_it_is_measured) {
  const ProgramResult result = run_program(
      words({"compare", "corner", "-o", folder_ / "out", "--light", "sun", "--no-figures", "--json"}, small));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_FALSE(Json::parse(result.out)["ao"].contains("stages"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/ao_stages.csv"));
}

}  // namespace
}  // namespace umbrameter
