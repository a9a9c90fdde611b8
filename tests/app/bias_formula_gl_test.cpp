// The formula that a sweep over several axes reports, where mathematics knows it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/gl_run.h"
#include "tests/support/expect_words.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

struct BiasFormulaRun : GlRun {};

double value_of(const Json& formula, const char* key) { return formula.at(key).at("value").get<double>(); }

// Least bias without acne on a plane, for texels of t metres, the angle θ between light and normal, the azimuth ψ of
// the slope on the map, p = |cos ψ| and q = |sin ψ|: (r + ½) · t · (p + q) · tan θ for (2r+1)² nearest taps, and (r +
// 1) times that length for bilinear ones, which reach half a texel farther. So bias = (½ + 1 · radius) · Δz.
TEST_F(BiasFormulaRun, Of_a_plane_is_half_the_depth_per_texel_and_once_more_for_each_texel_of_the_filter) {
  std::vector<std::string> words = {"sweep",   "tilted-plane", "-o",           folder_ / "out",   "--size", "160x90",
                                    "--quiet", "--json",       "--no-figures", "--shadow.filter", "box"};
  for (const char* axis : {"shadow.constant-bias=0.02texels:8texels:400", "view.light=sun-30,sun-60,sun-60-azimuth-45",
                           "shadow.filter-size=1,5", "shadow.filter-taps=nearest,linear", "shadow.resolution=256,1024"})
    words.insert(words.end(), {"--vary", axis});
  const ProgramResult result = run_program(words);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json formulas = Json::parse(result.out).at("curves").at("formulas");
  ASSERT_EQ(formulas.size(), 3u) << "all axes are in the formula: one set of three";
  const Json& formula = formulas.back();
  EXPECT_EQ(formula.at("bias"), "no acne");
  EXPECT_EQ(formula.at("points"), 3 * 2 * 2 * 2);
  EXPECT_EQ(formula.at("left_out"), 0);
  EXPECT_TRUE(formula.at("warnings").empty()) << formula;
  // The bias found on the axis is up to a step of 0.02 texels too large, and the pixels nearly find the worst place in
  // a texel; the smallest Δz is 0.58 texels.
  EXPECT_NEAR(value_of(formula, "per_depth_per_texel"), 0.5, 0.02);
  EXPECT_NEAR(value_of(formula, "per_radius_and_depth_per_texel"), 1.0, 0.01);
  EXPECT_NEAR(value_of(formula, "c0_m"), 0.0, 0.001);
  EXPECT_LT(formula.at("residual_texels"), 0.02) << "a step of the axis";
  EXPECT_LE(formula.at("residual_m"), formula.at("largest_residual_m"));
  EXPECT_EQ(formula.at("fitted_over").at("radius_texels"), (Json{0.0, 2.5}));
  ASSERT_EQ(formula.at("not_in_the_formula").size(), 1u);
  EXPECT_NE(formula.at("bias_m").get<std::string>().find(" * radius * depth_per_texel"), std::string::npos);
}

TEST_F(BiasFormulaRun, Warns_of_optima_at_the_end_of_the_axis_and_of_what_the_formula_does_not_reach) {
  // With 5 × 5 taps at 60° the bias needed is 2.5 · 1.73 = 4.3 texels, beyond the axis.
  const std::filesystem::path out = folder_ / "out";
  const ProgramResult result = run_program(
      {"sweep", "tilted-plane", "-o", out, "--size", "64x36", "--light", "sun-60", "--no-figures", "--shadow.filter",
       "box", "--vary", "shadow.constant-bias=0.05texels:4texels:80", "--vary", "shadow.filter-size=1,3,5", "--vary",
       "shadow.resolution=256,512", "--vary", "shadow.normal-offset=0,0.1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_words(text_of(out / "index.html"),
               {"Formula (normal-offset 0, no acne): bias ≈ (", "2 of 6 combinations are left out",
                "range does not reach 2 combinations, one of them filter-size 5, resolution 256",
                "r, the filter radius, takes only 2 values"});
  EXPECT_EQ(result.out.find("ormula"), std::string::npos) << "formulas are for the page: " << result.out;
  // The normal offset changes no length of the formula, so that each value of it has one.
  const Json formulas = Json::parse(text_of(out / "summary.json")).at("curves").at("formulas");
  ASSERT_EQ(formulas.size(), 6u);
  EXPECT_EQ(formulas.at(3).at("at").at("shadow.normal-offset"), 0.1);
  EXPECT_NE(text_of(out / "index.html").find("Formulas of the bias"), std::string::npos);
}

TEST_F(BiasFormulaRun, Two_resolutions_have_no_formula_and_no_empty_table) {
  const std::filesystem::path out = folder_ / "out";
  const ProgramResult result =
      run_program({"sweep", "tilted-plane", "-o", out, "--size", "64x36", "--light", "sun-60", "--no-figures", "--vary",
                   "shadow.constant-bias=0.05texels:4texels:20", "--vary", "shadow.filter-size=3,5", "--vary",
                   "shadow.resolution=256,512", "--shadow.filter", "box"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string page = text_of(out / "index.html");
  expect_words(page, {"There is no formula for the bias over ",
                      "4 do, but not enough of them have their bias inside the axis (2 for least error, "});
  EXPECT_EQ(page.find("Formulas of the bias"), std::string::npos);
}

TEST_F(BiasFormulaRun, The_resolution_alone_has_a_formula_also_where_a_search_finds_the_radius) {
  const ProgramResult result = run_program(
      {"sweep", "tilted-plane", "-o", folder_ / "out", "--size", "64x36", "--light", "sun-60", "--quiet", "--json",
       "--no-figures", "--vary", "shadow.constant-bias=0.05texels:4texels:80", "--vary",
       "shadow.resolution=256,512,1024", "--vary", "shadow.normal-offset=0,0.1", "--shadow.technique", "pcss"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json formulas = Json::parse(result.out).at("curves").at("formulas");
  ASSERT_EQ(formulas.size(), 6u) << "three biases at each of two normal offsets";
  EXPECT_NEAR(value_of(formulas.at(2), "per_depth_per_texel"), 0.5, 0.03);
  EXPECT_FALSE(formulas.at(2).at("fitted_over").contains("radius_texels"));
}

}  // namespace
}  // namespace umbrameter
