// The shape of a shadow error in whole runs.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/math.h"
#include "tests/app/gl_run.h"
#include "tests/scenes/gltf_files.h"
#include "tests/support/expect_words.h"

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

TEST_F(ShadowShapeRun, A_map_of_several_views_reports_each_view_its_seams_and_the_shimmer_of_its_fit) {
  const auto shape_of = [&](const std::vector<std::string>& settings) {
    std::vector<std::string> arguments{
        "compare", "contact-box",       "-o", folder_ / "views", "--force", "--size",
        "160x90",  "--truth.spp",       "4",  "--light",         "sun",     "--shadow.resolution",
        "256",     "--shadow.cascades", "3",  "--shimmer",       "--json",  "--quiet"};
    arguments.insert(arguments.end(), settings.begin(), settings.end());
    const ProgramResult result = run_program(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return Json::parse(result.out)["shadows"][0];
  };
  const Json by_causes = shape_of({"--shadow.fit", "view"});
  double share = 0.0;
  double mae = 0.0;
  for (const Json& view : by_causes["shape"]["views"]) {
    if (view["pixels"] == 0) continue;
    share += view["share"].get<double>();
    mae += view["share"].get<double>() * view["mae"].get<double>();
  }
  EXPECT_NEAR(share, 1.0, 1e-12);
  EXPECT_NEAR(mae, by_causes["statistics"]["mae"].get<double>(), 1e-6);
  EXPECT_GT(by_causes["shape"]["seams"]["pixels"].get<int>(), 0);
  EXPECT_GT(by_causes["shape"]["fit_shimmer"]["mean_change"].get<double>(), 0.0);
  const Json filtered = shape_of({"--shadow.technique", "vsm"})["shape"];
  EXPECT_TRUE(filtered["views"][0]["acne"].is_null());
  EXPECT_GT(filtered["shimmer"]["grid"]["mean"].get<double>(), 0.0);
}

// A texel of the finer map is a quarter of that of the coarser one, and far below a pixel.
TEST_F(ShadowShapeRun, Finer_texels_do_not_hide_contacts) {
  const auto contacts = [&](const char* resolution) {
    const ProgramResult result =
        run_program({"compare", "thin-leaf", "-o", folder_ / resolution, "--camera", "behind", "--light", "sun",
                     "--size", "240x135", "--truth.spp", "4", "--shadow.constant-bias", "0.1", "--shadow.resolution",
                     resolution, "--json", "--quiet"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return Json::parse(result.out)["shadows"][0]["shape"]["contact_search"]["measured_px"].get<int>();
  };
  const int coarse = contacts("1024");
  EXPECT_GT(coarse, 40);
  EXPECT_GT(contacts("4096"), 0.9 * coarse);
}

// A small triangle 0.4 m above a larger one, under a bias of 1 m that erases all shadow.
TEST_F(ShadowShapeRun, A_run_says_why_no_contact_gap_could_be_measured) {
  const std::string nodes =
      R"("nodes":[{"mesh":0,"name":"ground"},{"mesh":0,"name":"cover","translation":[0.1,0.1,0.4],"scale":[0.3,0.3,1]},)"
      R"({"name":"sun","extensions":{"KHR_lights_punctual":{"light":0}},"rotation":[0.1736482,0,0,0.9848078]}])";
  const std::string lights = R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional"}]}})";
  const auto file =
      folder_.write("cover.glb", test::glb(test::triangle_json(nodes, lights), test::triangle_positions()));
  const ProgramResult result = run_program({"compare", file.string(), "-o", folder_ / "out", "--size", "160x90",
                                            "--truth.spp", "4", "--shadow.constant-bias", "1", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json summary = Json::parse(result.out);
  const Json& shadow = summary["shadows"][0];
  ASSERT_GT(shadow["statistics"]["peter_panning"], 0.0);
  const Json& search = shadow["shape"]["contact_search"];
  EXPECT_GT(search["shadowed_px"], 0);
  EXPECT_EQ(search["distant_px"], search["shadowed_px"]);
  EXPECT_EQ(search["measured_px"], 0);
  const std::string reason = search["not_measured_because"];
  EXPECT_NE(reason.find("no contact gap could be measured: none of the "), std::string::npos) << reason;
  EXPECT_NE(reason.find(" pixels in shadow lies beside its caster"), std::string::npos) << reason;
  EXPECT_NE(result.err.find(reason), std::string::npos) << result.err;
  EXPECT_NE(text_of(folder_ / "out/index.html").find(reason), std::string::npos);
}

// No bias mends what a near plane cuts off, what lies inside the light, or what faces a part of it.
TEST_F(ShadowShapeRun, An_error_that_no_bias_mends_is_named) {
  const auto notes = [&](std::vector<std::string> command) {
    for (const char* each : {"-o", "OUT", "--measure", "shadows", "--size", "160x90", "--no-figures", "--force"})
      command.emplace_back(each == std::string("OUT") ? (folder_ / "out").string() : each);
    const ProgramResult result = run_program(command);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  };
  const auto at_near = [&](const std::string& near) {
    std::string text = notes({"compare", "courtyard", "--camera", "arcade", "--light", "lantern",
                              "--shadow.depth-encoding", "perspective", "--shadow.depth-near", near});
    const Json summary = Json::parse(text_of(folder_ / "out/summary.json"));
    return std::pair(summary["shadows"][0]["statistics"]["leak"].get<double>(), std::move(text));
  };
  const auto [leak, note] = at_near("0.5");
  const auto [less, silence] = at_near("0.05");
  const std::string start = "note: lantern: an error of ";
  ASSERT_NE(note.find(start), std::string::npos) << note;
  EXPECT_NEAR(0.01 * std::stod(note.substr(note.find(start) + start.size())), leak - less, 0.005);
  EXPECT_NE(note.find("nearer to the light than shadow.depth-near, 50 cm"), std::string::npos) << note;
  EXPECT_EQ(silence.find("nearer to the light"), std::string::npos) << silence;

  const std::string within = notes({"compare", "thin-leaf", "--light", "lamp", "--light.radius", "8"});
  EXPECT_NE(within.find("lamp: 100 % of the counted pixels are inside the light"), std::string::npos) << within;
  // Faces whose plane holds the sun's direction count at any extent.
  const std::string edge_on =
      notes({"compare", "contact-box", "--camera", "front-row", "--light", "sun-across", "--light.angle", "0.1"});
  EXPECT_NE(edge_on.find(" % of the counted pixels do not face the light's centre"), std::string::npos) << edge_on;
}

TEST_F(ShadowShapeRun, The_table_of_casters_says_how_many_it_leaves_out_and_the_largest_gap_of_all) {
  ASSERT_EQ(run_program({"compare", "courtyard", "-o", folder_ / "out", "--light", "sun", "--measure", "shadows",
                         "--size", "160x90", "--no-figures"})
                .exit_code,
            0);
  const Json shape = Json::parse(text_of(folder_ / "out/summary.json"))["shadows"][0]["shape"];
  double largest = -1.0;
  std::string object;
  int with_contacts = 0;
  for (const Json& caster : shape["casters"]) {
    const Json& gap = caster["contact_gap"];
    with_contacts += gap.contains("largest") ? 1 : 0;
    if (!gap.contains("largest") || !(gap["largest"]["m"].get<double>() > largest)) continue;
    largest = gap["largest"]["m"];
    object = caster["object"];
  }
  expect_words(text_of(folder_ / "out/index.html"),
               {"by caster: the 12 of " + std::to_string(shape["casters"].size()) + " with most contacts and edges",
                "The largest gap of the " + std::to_string(with_contacts) + " casters with contacts: ",
                " px), " + object + ". A gap is "});
}

}  // namespace
}  // namespace umbrameter
