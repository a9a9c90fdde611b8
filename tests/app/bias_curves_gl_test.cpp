// What whole sweeps say about the bias, where mathematics knows it.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

struct BiasCurvesRun : GlRun {};

TEST_F(BiasCurvesRun, The_formula_of_a_plane_is_half_the_depth_per_texel) {
  // One nearest tap, θ = 60°, ψ = 0: no acne from ½·Δz = ½·t·tan θ = 0.8660254 texels; on an axis in millimetres the
  // least such bias is up to 1 mm above.
  const ProgramResult result =
      run_program({"sweep", "tilted-plane", "-o", folder_ / "out", "--light", "sun-60", "--size", "320x180", "--quiet",
                   "--json", "--vary", "shadow.constant-bias=0:0.1:101", "--vary", "shadow.slope-bias=0,0.1,0.2",
                   "--vary", "shadow.resolution=256,512,1024"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json curves = Json::parse(result.out).at("curves");
  ASSERT_EQ(curves.at("biases").size(), 3u);
  for (const Json& curve : curves.at("biases")) {
    const double texel = curve.at("mean_texel_m");
    const Json& free = curve.at("acne_free").at("constant_bias");
    EXPECT_NEAR(free.at("m").get<double>(), 0.8660254 * texel, 0.001 + 0.01 * texel) << curve;
    EXPECT_DOUBLE_EQ(free.at("texels").get<double>(), free.at("m").get<double>() / texel);
    EXPECT_GT(free.at("normalised_depth").get<double>(), 0.0);
    EXPECT_EQ(curve.at("front_cells"), 1) << "without casters there is no peter-panning";
    EXPECT_TRUE(curve.at("knee").is_null());
  }
  const Json& formula = curves.at("formulas").back();
  EXPECT_EQ(formula.at("bias"), "no acne");
  EXPECT_EQ(formula.at("points"), 3);
  EXPECT_NEAR(formula.at("per_depth_per_texel").at("value").get<double>(), 0.5, 0.03);
  EXPECT_NEAR(formula.at("fitted_over").at("depth_per_texel_texels").at(0).get<double>(), 1.7320508, 1e-3);
  EXPECT_LT(formula.at("residual_m").get<double>(), 0.001);
}

// Metres, where texels were meant: the box's shadow is gone at every bias but 0, which has acne.
TEST_F(BiasCurvesRun, Of_a_coarse_axis_the_answer_says_where_a_better_bias_may_be) {
  const auto answer = [&](const char* biases) {
    const ProgramResult result =
        run_program({"sweep", "contact-box", "-o", folder_ / "out", "--force", "--light", "sun", "--size", "160x90",
                     "--quiet", "--vary", std::string("shadow.constant-bias=") + biases});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  };
  const std::string coarse = answer("0,2,4");
  EXPECT_NE(coarse.find("between 0 m and 2 m a bias that was not swept may have less than half this error"),
            std::string::npos)
      << coarse;
  const std::string fine = answer("0:0.1:41");
  EXPECT_EQ(fine.find("that was not swept"), std::string::npos) << fine;
}

// Rings of a figure: points in that ink.
std::size_t count_rings(const std::filesystem::path& svg, const std::string& ink) {
  const std::string text = text_of(svg);
  std::size_t rings = 0;
  for (std::size_t at = text.find("<path"); at != std::string::npos; at = text.find("<path", at + 1)) {
    const std::string element = text.substr(at, text.find('>', at) - at);
    const bool is_point = element.find("roledescription=\"point\"") != std::string::npos;
    rings += is_point && element.find(ink) != std::string::npos ? 1u : 0u;
  }
  return rings;
}

TEST_F(BiasCurvesRun, Figures_ring_what_was_read_and_the_page_tells_it) {
  const std::filesystem::path out = folder_ / "out";
  const ProgramResult result = run_program({"sweep", "contact-box", "-o", out, "--light", "sun", "--size", "160x90",
                                            "--quiet", "--json", "--vary", "shadow.constant-bias=0:0.1:11", "--vary",
                                            "shadow.slope-bias=0:2:33", "--vary", "shadow.resolution=64,128,256,512"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json curves = Json::parse(result.out).at("curves");
  const std::filesystem::path figures = out / "figures";
  // One a resolution, also where its slope-scaled bias is one of those that are left out of the map's rows.
  EXPECT_EQ(count_rings(figures / "mae_biases.svg", "stroke=\"white\""), 4u);
  EXPECT_EQ(count_rings(figures / "mae_lines.svg", "stroke=\"white\""), 4u);
  std::size_t fitted = 0;
  for (const Json& formula : curves.at("formulas")) {
    EXPECT_EQ(formula.at("points").get<int>() + formula.at("left_out").get<int>(), 4) << formula;
    if (formula.contains("bias_m")) fitted += formula.at("points").get<std::size_t>();
  }
  ASSERT_GT(fitted, 0u);
  EXPECT_EQ(count_rings(figures / "bias_fit.svg", "fill=\"white\""), fitted)
      << "biases that were left out are not drawn";
  std::size_t knees = 0;
  for (const Json& curve : curves.at("biases")) knees += curve.at("knee").is_null() ? 0u : 1u;
  EXPECT_EQ(count_rings(figures / "pareto_front.svg", "fill=\"white\""), knees);

  const std::string page = text_of(out / "index.html");
  EXPECT_NE(page.find("one of every 2 values of shadow.slope-bias"), std::string::npos);
  EXPECT_NE(page.find("A bias of 0 is not on this log axis"), std::string::npos);
  for (const char* title : {"Recommended biases", "Constant biases by slope-scaled bias", "Formulas of the bias"}) {
    EXPECT_NE(page.find(title), std::string::npos) << title;
  }
}

TEST_F(BiasCurvesRun, Biases_below_0_have_their_place) {
  const std::filesystem::path out = folder_ / "out";
  const ProgramResult result = run_program({"sweep", "corner", "-o", out, "--light", "0", "--size", "64x36", "--quiet",
                                            "--vary", "shadow.constant-bias=-0.1:0.1:21"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string figure = text_of(out / "figures/mae.svg");
  EXPECT_NE(figure.find("−0.1"), std::string::npos) << "the axis begins there";
  EXPECT_EQ(text_of(out / "index.html").find("is not on this log axis"), std::string::npos);
}

}  // namespace
}  // namespace umbrameter
