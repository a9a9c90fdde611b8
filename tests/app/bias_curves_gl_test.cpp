// What whole sweeps say about the bias, where mathematics knows it.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

struct BiasCurvesRun : GlRun {};

TEST_F(BiasCurvesRun, The_law_of_a_plane_is_half_a_texel_of_slope) {
  // One nearest tap, θ = 60°, ψ = 0: no acne from ½·t·tan θ = 0.8660254 texels, less s·tan θ for a slope-scaled bias s.
  // So c1 = ½ and tan θ = 1.7320508; on an axis in millimetres the least such bias is up to 1 mm above.
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
  const Json& law = curves.at("laws").back();
  EXPECT_EQ(law.at("bias"), "no acne");
  EXPECT_EQ(law.at("points"), 3);
  EXPECT_NEAR(law.at("c1_tangent_texels").at("value").get<double>(), 0.8660254, 0.05);
  EXPECT_LT(law.at("residual_m").get<double>(), 0.001);
  const Json& over_slopes = law.at("over_slope_biases");
  EXPECT_EQ(over_slopes.at("points"), 9);
  EXPECT_NEAR(over_slopes.at("tangent").at("value").get<double>(), 1.7320508, 0.1);
  EXPECT_NEAR(over_slopes.at("c1_texels").at("value").get<double>(), 0.5, 0.025);
  EXPECT_LT(over_slopes.at("residual_m").get<double>(), 0.001);
}

}  // namespace
}  // namespace umbrameter
