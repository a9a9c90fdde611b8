// The shape of a shadow error in whole runs.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/math.h"
#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

struct ShadowShapeRun : GlRun {};

// The sheet of 1 cm stands across the way of a sun 40° high: a lit strip of b cos e − w behind it, known to half a
// pixel.
TEST_F(ShadowShapeRun, The_contact_gap_of_a_standing_sheet_is_what_its_thickness_leaves_of_the_bias) {
  const ProgramResult result =
      run_program({"compare", "thin-leaf", "-o", folder_ / "out", "--camera", "behind", "--light", "sun", "--size",
                   "480x270", "--truth.spp", "16", "--shadow.constant-bias", "0.1", "--shimmer", "--json", "--quiet"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json shape = Json::parse(result.out)["shadows"][0]["shape"];
  bool found = false;
  for (const Json& caster : shape["casters"]) {
    if (caster["object"] != "standing 1 cm") continue;
    found = true;
    const Json& gap = caster["contact_gap"];
    EXPECT_GT(gap["contacts_px"].get<int>(), 40);
    // Along each of the two sides of the shadow a texel's edge may take the last row of pixels as a whole.
    EXPECT_LE(gap["lost_px"], 2);
    const double metres = gap["median"]["m"];
    const double pixel = metres / gap["median"]["px"].get<double>();
    EXPECT_NEAR(metres, 0.1 * std::cos(40.0 * pi / 180.0) - 0.01, 0.5 * pixel);
  }
  EXPECT_TRUE(found);

  const Json& shimmer = shape["shimmer"];
  EXPECT_GT(shimmer["grid"]["mean"].get<double>(), 0.0);
  EXPECT_LT(shimmer["grid"]["largest"].get<double>(), 0.05);
  EXPECT_GT(shimmer["camera"]["pixels"].get<int>(), 10000);
  EXPECT_GT(shimmer["camera"]["truth"].get<double>(), 0.0);
}

}  // namespace
}  // namespace umbrameter
