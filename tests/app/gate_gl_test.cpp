// A gate on runs of the program: a doubled bias breaks the budget of the run before, on the right statistics.
#include <nlohmann/json.hpp>

#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

class Gate : public GlRun {
 protected:
  std::string compare(const std::string& output, const std::string& bias, int exit_code = 0,
                      const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {
        "compare",      "courtyard", "--light", "sun",         "-o", folder_ / output,         "--size", "320x180",
        "--no-figures", "--quiet",   "--force", "--truth.spp", "16", "--shadow.constant-bias", bias};
    const ProgramResult result = run_program(words(arguments, more));
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    return result.out;
  }
};

TEST_F(Gate, Fails_on_the_statistics_that_a_doubled_bias_worsens) {
  compare("before", "1.5texels");
  compare("after", "3texels");
  const std::string budget = folder_ / "budget.toml";
  ASSERT_EQ(run_program({"check", folder_ / "before", "--budget", budget, "--update"}).exit_code, 0);
  EXPECT_EQ(run_program({"check", folder_ / "before", "--budget", budget}).exit_code, 0);

  const ProgramResult after = run_program({"check", folder_ / "after", "--budget", budget, "--json"});
  EXPECT_EQ(after.exit_code, 1) << after.err;
  std::set<std::string> broken;
  const nlohmann::json result = nlohmann::json::parse(after.out);
  for (const nlohmann::json& check : result["checks"]) {
    if (!check["kept"]) broken.insert(check["statistic"].get<std::string>());
  }
  // More bias removes more occluders and less acne; what else changes stays within the head room.
  EXPECT_TRUE(broken.contains("peter_panning"));
  EXPECT_FALSE(broken.contains("acne"));
  EXPECT_FALSE(broken.contains("false_occlusion"));
}

TEST_F(Gate, Compare_fails_if_a_condition_holds) {
  const std::string failed = compare("out", "1.5texels", 1, {"--fail-if", "acne>0.1%", "--fail-if", "lit<1%"});
  EXPECT_NE(failed.find("1 of 2 bounds is broken"), std::string::npos) << failed;
  const std::string passed = compare("out", "1.5texels", 0, {"--fail-if", "acne > 90%", "--fail-if", "psnr<5dB"});
  // PSNR of visibility and of AO
  EXPECT_NE(passed.find("all 3 bounds are kept; nearest to its bound: courtyard, "), std::string::npos) << passed;

  const ProgramResult unknown = run_program({"compare", "courtyard", "-o", folder_ / "new", "--fail-if", "acme>1%"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("did you mean 'acne'"), std::string::npos) << unknown.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "new"));
}

}  // namespace
}  // namespace umbrameter
