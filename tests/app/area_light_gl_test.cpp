// Whole runs with lights that have extent: the files they write and what a sweep reports.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "tests/app/gl_run.h"
#include "tests/scenes/gltf_files.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

Image<float> layer(const std::filesystem::path& exr, const std::string& name) {
  for (const Channel& channel : read_exr(exr).channels) {
    if (channel.name == name) return channel.values;
  }
  ADD_FAILURE() << "no layer " << name;
  return {};
}

using AreaLightRun = GlRun;

TEST_F(AreaLightRun, The_hard_reference_beside_the_soft_one_is_named_as_such) {
  ProgramOptions options;
  options.environment = {"XDG_CACHE_HOME=" + (folder_ / "home").string()};
  const auto notes = [&] {
    return run_program({"compare", "corner", "-o", folder_ / "out", "--force", "--light", "sun", "--light.angle", "6",
                        "--size", "96x54", "--truth.spp", "16", "--measure", "shadows", "--no-figures"},
                       options)
        .err;
  };
  notes();
  const std::string again = notes();
  EXPECT_NE(again.find("soft shadow of sun, camera overview: using"), std::string::npos) << again;
  EXPECT_NE(again.find("hard shadow of sun, camera overview: using"), std::string::npos) << again;
}

TEST_F(AreaLightRun, The_error_is_split_by_sign_with_intervals_and_has_no_causes) {
  const ProgramResult result = run_program(words(
      {"compare", "contact-box", "-o", folder_ / "out", "--light", "sun", "--light.angle", "8", "--json"}, small));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::set<std::string> layers = channel_names(folder_ / "out/images.exr");
  EXPECT_TRUE(layers.contains("truth_visibility_sun.Y"));
  EXPECT_TRUE(layers.contains("truth_visibility_standard_error_sun.Y"));
  EXPECT_TRUE(layers.contains("error_visibility_sun.Y"));
  EXPECT_FALSE(layers.contains("class_sun.Y"));
  const Json shadow = Json::parse(result.out)["shadows"][0];
  EXPECT_EQ(shadow["extent"]["kind"], "distant disk");
  EXPECT_DOUBLE_EQ(shadow["extent"]["angular_diameter_deg"], 8.0);
  const Json& statistics = shadow["statistics"];
  EXPECT_FALSE(statistics.contains("acne"));
  EXPECT_GT(statistics["penumbra"], 0.0);
  for (const char* name : {"lit", "mae", "rmse", "mean_error", "false_blocked", "false_lit"}) {
    const double value = statistics[name];
    EXPECT_LE(statistics[std::string(name) + "_lo"], value) << name;
    EXPECT_GE(statistics[std::string(name) + "_hi"], value) << name;
  }
  EXPECT_NEAR(statistics["mae"].get<double>(),
              statistics["false_blocked"].get<double>() + statistics["false_lit"].get<double>(), 1e-12);
  EXPECT_NE(text_of(folder_ / "out/index.html").find("split into too dark and too bright"), std::string::npos);
}

TEST_F(AreaLightRun, Stops_each_pixel_at_the_tolerance_and_tells_how_well_it_is_known) {
  const ProgramResult result =
      run_program({"compare", "contact-box", "-o", folder_ / "out", "--light", "sun", "--light.angle", "8", "--size",
                   "64x36", "--truth.tolerance", "0.05", "--truth.min-spp", "64", "--verbose"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json shadow = Json::parse(text_of(folder_ / "out/summary.json"))["shadows"][0];
  const Json& truth = shadow["truth"];
  EXPECT_LE(truth["worst_half_width_95"], 0.05);
  EXPECT_GT(truth["mean_half_width_95"], 0.0);
  EXPECT_EQ(truth["pixels_at_limit"], 0);
  EXPECT_GT(truth["largest_offset_m"], 0.0);
  EXPECT_GE(truth["pixels"], shadow["statistics"]["pixels"]) << "all counted pixels of this view are sampled";
  double samples = 0.0;
  for (const float n : layer(folder_ / "out/images.exr", "truth_visibility_samples_sun.Y").pixels) samples += n;
  EXPECT_NEAR(samples / truth["pixels"].get<double>(), truth["mean_samples"].get<double>(), 1e-6);
  const std::string page = text_of(folder_ / "out/index.html");
  EXPECT_NE(page.find("offset of at most"), std::string::npos);
  EXPECT_NE(page.find("rays per pixel on average, the interval"), std::string::npos);
  // What it cost is on stderr alone: files of equal runs are equal.
  for (const char* part : {" triangles; built in ", " shadow rays in ", " hemisphere rays in ", " Mray/s",
                           "offset at most ", "peak memory "}) {
    EXPECT_NE(result.err.find(part), std::string::npos) << part << "\n" << result.err;
    EXPECT_EQ(page.find(" Mray/s"), std::string::npos);
  }
}

TEST_F(AreaLightRun, A_sweep_over_the_extent_starts_at_the_hard_shadow) {
  ASSERT_EQ(run_program(words({"sweep", "contact-box", "-o", folder_ / "sweep", "--light", "sun", "--vary",
                               "light.angle=0,4,16"},
                              small))
                .exit_code,
            0);
  const std::string csv = text_of(folder_ / "sweep/sweep.csv");
  EXPECT_EQ(csv.rfind("light.angle,pixels,lit,lit_lo,lit_hi,penumbra,penumbra_lo,penumbra_hi,mae,mae_lo,mae_hi,", 0),
            0u)
      << csv.substr(0, 99);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3);
  const ProgramResult hard =
      run_program(words({"compare", "contact-box", "-o", folder_ / "hard", "--light", "sun", "--json"}, small));
  ASSERT_EQ(hard.exit_code, 0) << hard.err;
  const Json statistics = Json::parse(hard.out)["shadows"][0]["statistics"];
  // The angle, pixels, then lit three times, since nothing was sampled, then no penumbra, likewise, then the error. One
  // command adds up pixels and the other counts taps.
  const double lit = statistics["lit"];
  std::istringstream row(csv.substr(csv.find('\n') + 1));
  for (const double expected :
       {0.0, statistics["pixels"].get<double>(), lit, lit, lit, 0.0, 0.0, 0.0, statistics["mae"].get<double>()}) {
    double found = -1.0;
    char comma = 0;
    row >> found >> comma;
    EXPECT_NEAR(found, expected, 1e-12) << csv;
  }
}

TEST_F(AreaLightRun, The_least_error_of_a_sweep_has_the_interval_that_compare_gives_it) {
  const auto run = [&](const std::vector<std::string>& command) {
    const ProgramResult result =
        run_program(words(words(command, {"-o", folder_ / command.front(), "--light", "sun", "--light.angle", "8",
                                          "--measure", "visibility", "--no-figures"}),
                          small));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  };
  // Of a filter: the error of one tap has an interval, of greys bounds.
  const std::vector<std::string> box = {"--shadow.filter", "box"};
  const std::string sweep = run(words({"sweep", "contact-box", "--vary", "shadow.constant-bias=0.05,5"}, box));
  const std::string compared = run(words({"compare", "contact-box", "--shadow.constant-bias", "0.05"}, box));
  const std::size_t from = compared.find("error ");
  const std::string error = compared.substr(from, compared.find(" against", from) - from);
  ASSERT_NE(error.find(" to "), std::string::npos) << compared;
  EXPECT_EQ(sweep.find("least " + error + " at "), 0u) << sweep << compared;
  EXPECT_NE(text_of(folder_ / "sweep/index.html").find(error.substr(6)), std::string::npos);
}

TEST_F(AreaLightRun, The_extent_of_a_file_and_the_same_by_flag_give_the_same_answer) {
  const std::string members = R"("extensions":{"KHR_lights_punctual":{"light":0}},"translation":[0.5,0.5,2])";
  const auto file = [&](const std::string& name, const std::string& extras) {
    const std::string nodes = R"("nodes":[{"mesh":0},{)" + members + extras + "}]";
    return folder_
        .write(name, test::glb(test::triangle_json(
                                   nodes, R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}})"),
                               test::triangle_positions()))
        .string();
  };
  const std::string with = file("with.glb", R"(,"extras":{"radius":1.9})");
  const std::string without = file("without.glb", "");
  const auto trace = [&](const std::string& scene, const std::string& name, const std::vector<std::string>& flags) {
    const ProgramResult result = run_program(words(words({"trace", scene, "-o", folder_ / name}, flags), small));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return folder_ / (name + "/images.exr");
  };
  const auto by_file = trace(with, "file", {});
  const auto by_flag = trace(without, "flag", {"--light.radius", "1.9"});
  const auto by_none = trace(with, "none", {"--light.radius", "0"});
  EXPECT_EQ(layer(by_file, "truth_visibility_0.Y"), layer(by_flag, "truth_visibility_0.Y"));
  EXPECT_EQ(layer(by_file, "truth_visibility_standard_error_0.Y"),
            layer(by_flag, "truth_visibility_standard_error_0.Y"));
  EXPECT_FALSE(channel_names(by_none).contains("truth_visibility_standard_error_0.Y"));
  const ProgramResult info = run_program({"info", with});
  EXPECT_NE(info.out.find("sphere of radius 1.9 m"), std::string::npos) << info.out;
}

TEST(AreaLight, A_size_that_makes_no_sense_is_one_line_that_names_it) {
  const TemporaryFolder folder;
  const std::vector<std::vector<std::string>> commands = {
      {"trace", "contact-box"},
      {"sweep", "contact-box", "--light", "sun", "--vary", "shadow.resolution=16,32", "--quiet"}};
  const auto refused = [&](const std::vector<std::string>& flags, const std::string& word) {
    for (const std::vector<std::string>& command : commands) {
      const ProgramResult result = run_program(words(words(words(command, {"-o", folder / "out"}), flags), small));
      EXPECT_EQ(result.exit_code, 2) << result.err;
      EXPECT_TRUE(is_one_line(result.err)) << result.err;
      EXPECT_NE(result.err.find(word), std::string::npos) << result.err;
      EXPECT_FALSE(std::filesystem::exists(folder / "out/results.partial.sqlite")) << command.front();
    }
  };
  refused({"--light.radius", "1"}, "light.radius");
  refused({"--light.angle", "180"}, "light.angle");
  refused({"--light.angle", "nan"}, "light.angle");
  refused({"--light.radius", "-2"}, "light.radius");
  refused({"--light.width", "1"}, "one side");
  refused({"--light.shape", "cube"}, "usual, sphere or disk");
}

}  // namespace
}  // namespace umbrameter
