// --measure limits what compare, trace and raster trace, draw and report.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "reports/files/markup.h"
#include "tests/app/gl_run.h"
#include "tests/support/expect_words.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

const std::vector<std::string> few_pixels = {"--size", "48x27", "--truth.spp", "4", "--no-figures"};

struct MeasuredParts : GlRun {
  ProgramResult run(const std::string& command, const std::vector<std::string>& more) {
    const std::vector<std::string> first = {command, "corner", "-o", folder_ / "out", "--force", "--light", "0"};
    ProgramResult result = run_program(words(words(first, more), few_pixels));
    // The folder's random name may hold any two letters, "AO" too.
    result.out = replace_all(result.out, (folder_ / "out").string(), "out");
    return result;
  }
  Json summary() const { return Json::parse(text_of(folder_ / "out/summary.json")); }
  // Whether images.exr has a layer whose name has this part.
  bool has_layer(const std::string& part) const {
    const std::set<std::string> names = channel_names(folder_ / "out/images.exr");
    return std::ranges::any_of(names, [&](const std::string& name) { return name.find(part) != std::string::npos; });
  }
};

TEST_F(MeasuredParts, Shadows_alone_trace_and_draw_no_ambient_occlusion) {
  for (const std::string command : {"compare", "trace", "raster"}) {
    for (const std::string name : {"visibility", "shadows"}) {
      const ProgramResult result = run(command, {"--measure", name, "--verbose"});
      ASSERT_EQ(result.exit_code, 0) << result.err;
      EXPECT_EQ(result.out.find("AO"), std::string::npos) << result.out;
      EXPECT_EQ(summary()["shadows"].size(), 1u) << command;
      EXPECT_FALSE(summary().contains("ao")) << command;
      EXPECT_EQ(summary()["parameters"]["run.measure"], "visibility");
      EXPECT_TRUE(has_layer("_visibility_")) << command;
      EXPECT_FALSE(has_layer("_ao")) << command;
    }
  }
}

TEST_F(MeasuredParts, Ambient_occlusion_alone_traces_and_draws_no_shadows) {
  for (const std::string command : {"compare", "trace", "raster"}) {
    // What only shadow maps read is no error.
    const ProgramResult result = run(command, {"--measure", "ao", "--shadow.cascades", "2", "--light", "1"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(summary()["shadows"].empty()) << command;
    EXPECT_TRUE(summary().contains("ao")) << command;
    EXPECT_TRUE(has_layer("_ao")) << command;
    EXPECT_FALSE(has_layer("_visibility_")) << command;
  }
}

// The numbers are those of a run that measures both.
TEST_F(MeasuredParts, Measuring_one_part_does_not_change_its_numbers) {
  ASSERT_EQ(run("compare", {}).exit_code, 0);
  const Json both = summary();
  ASSERT_EQ(run("compare", {"--measure", "shadows"}).exit_code, 0);
  EXPECT_EQ(summary()["shadows"], both["shadows"]);
  ASSERT_EQ(run("compare", {"--measure", "ao"}).exit_code, 0);
  EXPECT_EQ(summary()["ao"], both["ao"]);
}

TEST_F(MeasuredParts, What_refers_to_a_part_that_is_not_measured_is_refused_before_any_work) {
  const auto refused = [&](const std::string& measure, const std::vector<std::string>& more, const std::string& what) {
    const ProgramResult result = run("compare", words({"--measure", measure}, more));
    EXPECT_EQ(result.exit_code, 2) << what;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("--measure " + measure), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  };
  refused("visibility", {"--ao-stages"}, "--ao-stages");
  refused("visibility", {"--write-ao-inputs"}, "--write-ao-inputs");
  refused("visibility", {"--overlay", "depth"}, "--overlay");
  refused("visibility", {"--fail-if", "ao.mae>5%"}, "ao.mae>5%");
  refused("ao", {"--shimmer"}, "--shimmer");
  refused("ao", {"--write-maps"}, "--write-maps");
  refused("ao", {"--fail-if", "acne>0.1%"}, "acne>0.1%");
}

TEST_F(MeasuredParts, The_error_of_the_answers_is_known_by_its_name) {
  const ProgramResult refused = run("compare", {"--fail-if", "error>5%"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("there is no statistic 'error'; its name is 'mae'"), std::string::npos) << refused.err;
  const std::string bright = run("compare", {"--fail-if", "too_bright>5%"}).err;
  EXPECT_NE(bright.find("; its name is 'false_lit'"), std::string::npos) << bright;
}

TEST_F(MeasuredParts, A_condition_on_a_cause_of_a_soft_shadow_is_refused_before_anything_is_measured) {
  const ProgramResult refused = run("compare", {"--truth.shadow", "pixel", "--fail-if", "acne>0.1%"});
  EXPECT_EQ(refused.exit_code, 2) << refused.out;
  EXPECT_NE(refused.err.find("--fail-if 'acne>0.1%'"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("false_blocked"), std::string::npos) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/summary.json"));
  const ProgramResult kept = run("compare", {"--truth.shadow", "pixel", "--fail-if", "false_blocked>99%"});
  EXPECT_EQ(kept.exit_code, 0) << kept.err;
}

TEST_F(MeasuredParts, A_condition_and_a_budget_hold_what_was_measured_and_name_what_was_not) {
  // Both kinds have a mean absolute error; of AO it would be larger than this.
  const ProgramResult kept = run("compare", {"--measure", "shadows", "--fail-if", "mae>99.99%"});
  EXPECT_EQ(kept.exit_code, 0) << kept.err;
  put_text(folder_ / "budget.toml",
           "[[budget]]\nstatistic = \"mae\"\nbound = \"<= 99.99%\"\n"
           "[[budget]]\nkind = \"ao\"\nstatistic = \"rmse\"\nbound = \"<= 99.99%\"\n");
  const ProgramResult result = run_program({"check", folder_ / "out", "--budget", folder_ / "budget.toml"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.out.find("1 of 2 bounds is measured by no run; the others are kept"), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("not measured"), std::string::npos) << result.out;
}

TEST_F(MeasuredParts, A_report_of_such_a_run_shows_what_it_measured) {
  ASSERT_EQ(run("compare", {"--measure", "shadows"}).exit_code, 0);
  const ProgramResult result = run_program({"report", folder_ / "out", "-o", folder_ / "report", "--no-figures"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(MeasuredParts, A_dry_run_names_the_parts) {
  const auto plan = [&](const std::string& measure) { return run("compare", {"--measure", measure, "--dry-run"}).out; };
  EXPECT_EQ(plan("shadows").find("AO"), std::string::npos) << plan("shadows");
  EXPECT_EQ(plan("ao").find("shadow"), std::string::npos) << plan("ao");
  EXPECT_NE(plan("ao").find("SSAO, 64 samples per pixel"), std::string::npos) << plan("ao");
  const std::string gtao = run("compare", {"--measure", "ao", "--dry-run", "--ao.technique", "gtao"}).out;
  EXPECT_NE(gtao.find("GTAO, 3 slices × 2 × 3 steps per pixel"), std::string::npos) << gtao;
}

TEST_F(MeasuredParts, A_dry_run_names_what_is_read_and_which_rays_are_traced) {
  const auto plan = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--measure", "shadows", "--dry-run"});
    return run("compare", more).out;
  };
  expect_words(plan({}), {" texels, pcf, nearest filter\n", "reference  1 ray per pixel for shadows\n"});
  expect_words(plan({"--shadow.technique", "vsm"}), {" texels, vsm\n"});
  expect_words(plan({"--shadow.technique", "screen-space"}), {"technique  screen-space\n"});
  expect_words(plan({"--truth.shadow", "pixel"}), {"reference  4 rays per pixel for the shadow of sun\n"});
  expect_words(plan({"--light.angle", "2", "--truth.shadow", "point"}), {"1 ray per pixel for shadows\n"});
}

}  // namespace
}  // namespace umbrameter
