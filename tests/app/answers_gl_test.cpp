// What a run answers, and what it must not claim: the bias to use, the reference's reach, ends of axes, nothing
// counted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/gl_run.h"
#include "tests/support/expect_words.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

struct Answers : GlRun {
  // Runs one command at a small size; what it prints on stdout, and its summary.
  std::string run(const std::vector<std::string>& command, const std::string& name = "out") {
    const ProgramResult result = run_program(words(words(command, {"-o", folder_ / name}), small));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    summary = Json::parse(text_of(folder_ / name / "summary.json"));
    return result.out;
  }
  Json summary;
};

TEST_F(Answers, Both_sides_of_ambient_occlusion_look_equally_far_unless_told_otherwise) {
  EXPECT_NE(run({"compare", "corner", "--ao.radius", "40cm", "--light", "0"}).find("reference rays up to 40 cm"),
            std::string::npos);
  EXPECT_EQ(summary["parameters"]["truth.ao-distance"], 0.4);
  EXPECT_NE(run({"compare", "corner", "--ao.radius", "40cm", "--truth.ao-distance", "0", "--light", "0"}, "unlimited")
                .find("without distance limit"),
            std::string::npos);
}

// write_figures() starts with the plots, which node draws.
TEST_F(Answers, Are_printed_before_any_figure_is_drawn) {
  namespace fs = std::filesystem;
  const fs::path programs = folder_ / "programs";
  fs::create_directories(programs);
  const std::string answer = (folder_ / "answer").string();
  // Before the node that is meant: notes whether the answer is in the file by now.
  put_text(programs / "node", "#!/bin/sh\ngrep -c '^AO' '" + answer + "' >>'" + (folder_ / "seen").string() +
                                  "'\nPATH=${PATH#*:} exec node \"$@\"\n");
  fs::permissions(programs / "node", fs::perms::owner_all);
  ProgramOptions options;
  options.wrapper = {"sh", "-c", "PATH='" + programs.string() + "':$PATH exec \"$@\" >'" + answer + "'", "sh"};
  const ProgramResult result = run_program(words({"compare", "corner", "-o", folder_ / "out"}, small), options);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(text_of(folder_ / "seen"), "1\n");
  EXPECT_EQ(text_of(folder_ / "out/figures/truth_ao.png").substr(0, 4), "\x89PNG");
}

TEST_F(Answers, A_sweep_over_the_radius_keeps_the_reference_and_says_how_far_it_looks) {
  const std::string out = run({"sweep", "corner", "--vary", "ao.radius=0.2,0.4,0.8", "--ao.radius", "0.5"});
  EXPECT_NE(first_line(out).find("(reference rays up to 50 cm)"), std::string::npos) << out;
  EXPECT_EQ(summary["parameters"]["truth.ao-distance"], 0.5);
  // One reference: its mean is the same in every row.
  std::istringstream rows(text_of(folder_ / "out/sweep.csv"));
  std::string line;
  std::getline(rows, line);
  std::set<std::string> means;
  while (std::getline(rows, line)) {
    std::size_t begin = 0;
    for (int column = 0; column < 12; ++column) begin = line.find(',', begin) + 1;
    means.insert(line.substr(begin, line.find(',', begin) - begin));
  }
  EXPECT_EQ(means.size(), 1u);
}

TEST_F(Answers, An_axis_that_ends_too_early_is_said_to_and_its_end_is_not_called_the_least_error) {
  const std::string out = run({"sweep", "tilted-plane", "--light", "0", "--vary", "shadow.constant-bias=0:1mm:5"});
  EXPECT_NE(out.find("shadow.constant-bias: the least error is at the upper end of the axis (0.001 m); extend it"),
            std::string::npos)
      << out;
  ASSERT_EQ(summary["sweep"]["open_ends"].size(), 1u);
  EXPECT_EQ(summary["sweep"]["open_ends"][0]["end"], "upper");
  const std::string page = text_of(folder_ / "out/index.html");
  EXPECT_NE(page.find("the least error is at the upper end"), std::string::npos);
  EXPECT_NE(page.find("least mean absolute error tested"), std::string::npos);

  // A polygon offset that is too large needs a negative bias, so that 0 is an end, too.
  const std::string offset = run({"sweep", "two-occluders", "--light", "sun", "--shadow.resolution", "256", "--vary",
                                  "shadow.constant-bias=0texels:4texels:9", "--shadow.polygon-offset-factor", "4",
                                  "--shadow.polygon-offset-units", "64"},
                                 "offset");
  EXPECT_NE(offset.find("shadow.constant-bias: the least error is at the lower end of the axis (0 texels)"),
            std::string::npos)
      << offset;
  const std::string tuned = run({"tune", "two-occluders", "--light", "sun", "--shadow.resolution", "256", "--vary",
                                 "shadow.constant-bias=0texels:4texels", "--shadow.polygon-offset-factor", "4",
                                 "--shadow.polygon-offset-units", "64", "--no-figures"},
                                "tuned");
  EXPECT_NE(tuned.find("warning: shadow.constant-bias: the best value "), std::string::npos) << tuned;
  EXPECT_NE(tuned.find(" texels is the lower end of the axis"), std::string::npos) << tuned;

  // The end of either of two axes.
  for (const char* samples : {"ao.samples=16,64", "ao.samples=16,32,64,128"}) {
    const std::string both =
        run({"sweep", "corner", "--no-figures", "--vary", "ao.radius=0.1,0.2,0.4", "--vary", samples}, samples);
    EXPECT_NE(both.find("ao.radius: the least error is at the lower end of the axis (0.1 m)"), std::string::npos)
        << both;
  }

  // On a plane a bias without acne is right, and more is no better.
  run({"sweep", "tilted-plane", "--light", "0", "--vary", "shadow.constant-bias=0:10:5"}, "far");
  EXPECT_TRUE(summary["sweep"]["open_ends"].empty()) << summary["sweep"]["open_ends"];
}

// The light's size changes the reference: there is no best one.
TEST_F(Answers, An_axis_of_the_reference_is_not_to_be_extended_and_edges_that_are_measured_are_not_asked_for) {
  const std::string sizes = run({"sweep", "contact-box", "--no-figures", "--truth.spp", "16", "--vary",
                                 "light.angle=0,2", "--vary", "shadow.filter=nearest,box"});
  EXPECT_EQ(sizes.find("extend it"), std::string::npos) << sizes;
  const auto filters = [&](const std::string& metrics) {
    return run({"sweep", "contact-box", "--light", "sun", "--no-figures", "--run.metrics", metrics, "--vary",
                "shadow.filter=nearest,box"},
               "filters-" + metrics);
  };
  EXPECT_NE(filters("ssim").find("does not show which filter is best"), std::string::npos);
  const std::string edges = filters("edge-roughness");
  EXPECT_EQ(edges.find("use --run.metrics"), std::string::npos) << edges;
  EXPECT_NE(edges.find("; the column edge-roughness of sweep.csv does"), std::string::npos) << edges;
}

// Without casters no bias of a plane is wrong that is large enough.
TEST_F(Answers, Cells_or_points_that_are_all_equal_are_said_to_be_and_none_is_called_best) {
  const std::string cells =
      run({"sweep", "tilted-plane", "--light", "sun-60", "--no-figures", "--vary", "shadow.constant-bias=1,2,3"});
  EXPECT_TRUE(first_line(cells) == "all 3 cells are equal: error 0 %; shadow.constant-bias changes nothing here")
      << cells;
  EXPECT_EQ(cells.find("least"), std::string::npos) << cells;
  EXPECT_EQ(text_of(folder_ / "out/index.html").find(" in the cell of least error"), std::string::npos);
  const std::string points =
      run({"tune", "tilted-plane", "--light", "sun-60", "--no-figures", "--vary", "shadow.constant-bias=1:3"}, "tuned");
  EXPECT_TRUE(first_line(points).ends_with(
      " evaluated points are equal: mean absolute error 0 %; shadow.constant-bias changes nothing here"))
      << points;
  EXPECT_EQ(points.find("best: "), std::string::npos) << points;
}

TEST_F(Answers, Compare_begins_with_the_bias_to_use_and_a_run_with_it_has_that_error) {
  const auto compare = [&](const std::string& bias, const std::string& name) {
    return run({"compare", "courtyard", "--light", "lantern", "--no-figures", "--shadow.resolution", "256",
                "--shadow.constant-bias", bias},
               name);
  };
  const std::string out = compare("2mm", "used");
  EXPECT_TRUE(first_line(out).starts_with("lantern: use ")) << out;
  EXPECT_NE(first_line(out).find(" have at most 3 wrong pixels more than the least error ("), std::string::npos)
      << "few are wrong: " << out;
  const Json advice = summary["shadows"][0]["recommended_bias"];
  const Json& recommended = advice["recommended"];
  EXPECT_TRUE(advice["withheld"].is_null());
  EXPECT_FALSE(advice["keep"]);
  const double pixels = summary["shadows"][0]["statistics"]["pixels"];
  EXPECT_LE(recommended["mae"].get<double>(), advice["least_error"]["mae"].get<double>() + 3.0 / pixels);
  EXPECT_LE(advice["range"]["smallest"]["m"], recommended["constant_bias"]["m"]);
  EXPECT_GE(advice["range"]["largest"]["m"], recommended["constant_bias"]["m"]);
  EXPECT_DOUBLE_EQ(advice["used"]["mae"].get<double>(), summary["shadows"][0]["statistics"]["mae"].get<double>());
  const std::string second = compare(std::to_string(recommended["constant_bias"]["m"].get<double>()), "best");
  EXPECT_TRUE(first_line(second).starts_with("lantern: keep ")) << second;
  EXPECT_TRUE(summary["shadows"][0]["recommended_bias"]["keep"]);
  EXPECT_DOUBLE_EQ(summary["shadows"][0]["statistics"]["mae"].get<double>(), recommended["mae"].get<double>());
  compare(std::to_string(advice["acne_free"]["constant_bias"]["m"].get<double>()), "free");
  EXPECT_EQ(summary["shadows"][0]["statistics"]["acne"], 0.0);
}

TEST_F(Answers, A_sweep_recommends_by_the_rule_of_compare) {
  const std::string out = run({"sweep", "contact-box", "--light", "sun", "--no-figures", "--vary",
                               "shadow.constant-bias=0texels:6texels:61", "--vary", "shadow.resolution=128,256"});
  EXPECT_TRUE(first_line(out).starts_with("resolution 128: use ")) << out;
  const double pixels = summary["shadows"][0]["statistics"]["pixels"];
  for (const Json& curve : summary["curves"]["biases"]) {
    const Json& recommended = curve["recommended"];
    const double least = curve["least_error"]["mae"];
    EXPECT_LE(recommended["mae"].get<double>(), std::max(1.05 * least, least + 3.0 / pixels) + 1e-9);
    EXPECT_LE(recommended["constant_bias"]["m"], curve["least_error"]["constant_bias"]["m"]);
  }
  const Json of_sweep = summary["curves"]["biases"][1]["recommended"]["constant_bias"]["texels"];
  run({"compare", "contact-box", "--light", "sun", "--no-figures", "--shadow.resolution", "256"}, "compare");
  const Json of_compare = summary["shadows"][0]["recommended_bias"]["recommended"]["constant_bias"]["texels"];
  EXPECT_NEAR(of_sweep.get<double>(), of_compare.get<double>(), 0.1) << "a step of the axis";

  const std::string plane =
      run({"sweep", "tilted-plane", "--light", "0", "--vary", "shadow.constant-bias=0:1:11"}, "plane");
  EXPECT_TRUE(first_line(plane).starts_with("no bias recommended: no counted pixel is in shadow")) << plane;
  EXPECT_TRUE(summary["curves"]["biases"][0]["recommended"].is_null());
}

TEST_F(Answers, A_bias_in_texels_is_the_same_in_a_single_run_a_sweep_and_in_metres_of_a_directional_map) {
  run({"compare", "courtyard", "--light", "sun", "--no-figures", "--shadow.constant-bias", "1.5texels"}, "texels");
  const Json texels = summary["shadows"][0];
  EXPECT_DOUBLE_EQ(texels["constant_bias"]["texels"].get<double>(), 1.5);
  EXPECT_DOUBLE_EQ(texels["constant_bias"]["m"].get<double>(), 1.5 * texels["map"]["mean_texel_m"].get<double>());
  run({"sweep", "courtyard", "--light", "sun", "--no-figures", "--vary", "shadow.constant-bias=0.5texels,1.5texels"},
      "sweep");
  const Json& curve = summary["curves"]["biases"][0]["least_error"];
  EXPECT_DOUBLE_EQ(curve["mae"].get<double>(), texels["statistics"]["mae"].get<double>());
  EXPECT_DOUBLE_EQ(curve["constant_bias"]["texels"].get<double>(), 1.5);
  EXPECT_DOUBLE_EQ(curve["constant_bias"]["m"].get<double>(), texels["constant_bias"]["m"].get<double>());
  // Bias is texel size times 1.5 at every receiver, which a directional map has alike everywhere.
  std::ostringstream metres;
  metres.precision(17);
  metres << texels["constant_bias"]["m"].get<double>();
  run({"compare", "courtyard", "--light", "sun", "--no-figures", "--shadow.constant-bias", metres.str()}, "metres");
  EXPECT_NEAR(summary["shadows"][0]["statistics"]["mae"].get<double>(), texels["statistics"]["mae"].get<double>(),
              2e-3);
}

TEST_F(Answers, A_camera_that_sees_nothing_gets_a_reason_and_no_error) {
  folder_.write("away.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
    "nodes":[{"mesh":0},{"camera":0,"translation":[0,0,5],"rotation":[0,1,0,0]}],
    "cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1}}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,
      "uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
  const std::string out = run({"compare", folder_ / "away.gltf"});
  EXPECT_EQ(first_line(out), "sun: nothing to measure: all 5184 pixels are background") << out;
  EXPECT_NE(out.find("AO: nothing to measure"), std::string::npos);
  EXPECT_EQ(out.find("0.000"), std::string::npos);
  EXPECT_EQ(summary["shadows"][0]["not_measured"], "nothing to measure: all 5184 pixels are background");
  EXPECT_TRUE(summary["shadows"][0]["statistics"]["mae"].is_null());
  EXPECT_TRUE(summary["ao"]["statistics"]["mae"].is_null());
  EXPECT_NE(text_of(folder_ / "out/index.html").find("all 5184 pixels are background"), std::string::npos);

  const std::string swept = run({"sweep", folder_ / "away.gltf", "--vary", "shadow.constant-bias=0,0.1"}, "sweep");
  EXPECT_EQ(first_line(swept), "nothing to measure: no cell of the sweep has counted pixels");
  EXPECT_EQ(text_of(folder_ / "sweep/sweep.csv").find("0,0,0,0"), std::string::npos);
}

TEST_F(Answers, Where_filters_are_compared_the_page_says_what_the_error_cannot_decide) {
  const std::string hard = run({"sweep", "contact-box", "--light", "0", "--vary", "shadow.filter=nearest,box"});
  constexpr const char* warning = "warning: against a hard shadow every blurred pixel is wrong";
  EXPECT_NE(hard.find(warning), std::string::npos) << hard;
  EXPECT_NE(hard.find("or use --run.metrics edge-roughness"), std::string::npos) << hard;
  const std::string soft = run({"sweep", "contact-box", "--light", "0", "--light.angle", "4", "--truth.spp", "4",
                                "--vary", "shadow.filter=nearest,box"},
                               "soft");
  EXPECT_EQ(soft.find(warning), std::string::npos) << "a soft shadow ranks filters";
  const auto techniques = [&](const char* filter) {
    return run({"sweep", "contact-box", "--light", "0", "--shadow.filter", filter, "--vary",
                "shadow.technique=pcf,pcss", "--force"},
               "techniques");
  };
  EXPECT_EQ(techniques("nearest").find(warning), std::string::npos) << "without extent PCSS blurs nothing";
  EXPECT_NE(techniques("box").find(warning), std::string::npos);
  EXPECT_NE(text_of(folder_ / "out/index.html").find("not a filter"), std::string::npos);
  EXPECT_NE(text_of(folder_ / "out/index.html").find("Ambient occlusion: none."), std::string::npos);
  run({"compare", "contact-box", "--light", "0", "--shadow.filter", "box"}, "box");
  EXPECT_NE(text_of(folder_ / "box/index.html").find("not a filter"), std::string::npos);
}

TEST_F(Answers, Quiet_prints_the_answer_only_and_verbose_adds_diagnostics) {
  const std::string out = run({"compare", "contact-box", "--light", "sun"});
  std::istringstream lines(out);
  std::string line;
  std::vector<std::string> starts;
  while (std::getline(lines, line)) starts.push_back(line.substr(0, line.find(':')));
  EXPECT_EQ(starts, (std::vector<std::string>{"sun", "AO", "warning"})) << out;
  const ProgramResult verbose = run_program({"compare", "contact-box", "--light", "sun", "-o", folder_ / "verbose",
                                             "--size", "96x54", "--truth.spp", "16", "--verbose"});
  EXPECT_NE(verbose.err.find("ray tests "), std::string::npos) << verbose.err;
  EXPECT_EQ(verbose.out.find("ray tests "), std::string::npos);
  // Taps of this filter have large weights, which are no number of taps.
  const ProgramResult weighted =
      run_program({"compare", "room", "--light", "sun", "-o", folder_ / "weighted", "--size", "240x135",
                   "--shadow.filter", "gaussian", "--measure", "visibility", "--no-figures", "--verbose"});
  expect_words(weighted.err, {"ray tests moved ", " taps first classed as false occlusion to acne."});
  // What did not occur is not said, here wrong taps on the receiver's own layer.
  const ProgramResult detached =
      run_program({"compare", "contact-box", "--light", "sun", "-o", folder_ / "detached", "--size", "96x54",
                   "--shadow.constant-bias", "0.3", "--measure", "visibility", "--verbose"});
  EXPECT_EQ(detached.out.find("peter-panning 0 %"), std::string::npos) << detached.out;
  EXPECT_EQ(detached.err.find("the receiver's own"), std::string::npos) << detached.err;
}

TEST_F(Answers, Few_pixels_are_counted_aloud_whatever_the_technique_and_command) {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"compare", "contact-box", "--measure", "shadows", "--light.angle", "8"},
        {"compare", "contact-box", "--measure", "shadows", "--shadow.technique", "vsm"},
        {"sweep", "contact-box", "--vary", "shadow.constant-bias=0texels:6texels:13"}}) {
    const ProgramResult result =
        run_program(words(command, {"-o", folder_ / "few", "--force", "--light", "sun", "--size", "9x5", "--truth.spp",
                                    "16", "--no-figures", "--quiet"}));
    EXPECT_NE(result.out.find("only 26 counted pixels"), std::string::npos) << result.out;
  }
}

TEST_F(Answers, A_bias_beside_the_recommended_one_does_not_read_like_it) {
  const ProgramResult result =
      run_program({"compare", "contact-box", "--light", "sun-low", "--measure", "shadows", "--no-figures", "--size",
                   "480x270", "--shadow.constant-bias", "1.499texels", "-o", folder_ / "out"});
  expect_words(result.out, {"sun-low: use bias 1.5 texels", "\n  sun-low at 1.499 texels: acne "});
}

TEST_F(Answers, Where_no_bias_is_recommended_the_reason_is_that_of_the_technique) {
  const auto of_box = [&](const std::vector<std::string>& settings) {
    return run(words({"compare", "contact-box", "--light", "sun", "--measure", "shadows", "--no-figures", "--force"},
                     settings));
  };
  const char* only_pcf = "no bias recommended: acne cannot be counted for vsm";
  expect_words(of_box({"--shadow.technique", "vsm"}), {only_pcf});
  expect_words(of_box({"--light.angle", "2", "--shadow.technique", "vsm"}), {only_pcf});
  const char* of_kernel = "no bias recommended: the kernel of pcss depends on the bias";
  expect_words(of_box({"--light.angle", "2", "--shadow.technique", "pcss"}), {of_kernel});
  expect_words(of_box({"--truth.shadow", "point", "--light.angle", "2", "--shadow.technique", "pcss"}), {of_kernel});
  expect_words(of_box({"--light.angle", "2"}), {"acne can be counted only in a hard shadow (--truth.shadow point: "});
  expect_words(of_box({"--shadow.contact-shadows", "true"}),
               {"no bias recommended: acne cannot be counted for pcf with contact shadows"});
}

// Screen-space shadows have no map, so neither its bias nor its resolution is a remedy.
TEST_F(Answers, Screen_space_shadows_alone_are_not_told_as_a_shadow_map) {
  const auto page = [&](const std::vector<std::string>& settings) {
    const std::string out =
        run(words({"compare", "contact-box", "--light", "sun", "--measure", "shadows", "--force"}, settings));
    return out + text_of(folder_ / "out/index.html");
  };
  const std::vector<std::string> of_map = {"Shadow map: sun", "Constant bias of these images", "a large bias",
                                           "choose a bias or a resolution", "the surfaces in the map have depths"};
  const char* blurred = "every blurred pixel is wrong";
  EXPECT_EQ(page({"--shadow.contact-shadows", "true"}).find(blurred), std::string::npos) << "the filter is nearest";
  const std::string with_map = page({"--shadow.contact-shadows", "true", "--shadow.filter", "gaussian"});
  EXPECT_NE(with_map.find(blurred), std::string::npos);
  expect_words(with_map, of_map);
  expect_words(with_map, {"; contact shadows: rays of 30 cm in 8 steps.", "(at most 2 texels away or"});
  for (const char* angle : {"0", "2"}) {
    const std::string alone = page({"--shadow.technique", "screen-space", "--light.angle", angle});
    expect_words(alone, {"no bias recommended: screen-space reads no shadow map",
                         "Screen-space shadows: rays of 30 cm in 8 steps."});
    if (angle == std::string("0")) expect_words(alone, {"(at most 2 texels of a 1024² map away or"});
    for (const std::string& words : of_map) EXPECT_EQ(alone.find(words), std::string::npos) << words;
  }
}

// PCSS and DPCF of a light without extent are PCF: they have its causes, its advice and its errors.
TEST_F(Answers, A_technique_that_lacks_its_extent_has_the_bias_of_PCF) {
  const auto answer = [&](const std::string& technique) {
    return run({"compare", "contact-box", "--light", "sun", "--measure", "shadows", "--no-figures", "--force",
                "--shadow.technique", technique, "--shadow.filter", technique == "pcf" ? "nearest" : "poisson"},
               technique);
  };
  const std::string pcf = first_line(answer("pcf"));
  const Json advice = summary["shadows"][0]["recommended_bias"];
  ASSERT_TRUE(advice["withheld"].is_null()) << pcf;
  for (const char* technique : {"pcss", "dpcf"}) {
    EXPECT_EQ(first_line(answer(technique)), pcf) << technique;
    EXPECT_EQ(summary["shadows"][0]["recommended_bias"], advice) << technique;
  }
}

TEST_F(Answers, Errors_of_several_lights_are_not_ranked) {
  const auto sweep = [&](const std::string& axis) {
    return run_program({"sweep", "courtyard", "--vary", axis, "--size", "96x54", "--no-figures", "-o", folder_ / "out",
                        "--force"})
        .out;
  };
  const char* warning = "warning: errors of different lights, cameras, scenes or references do not show";
  expect_words(sweep("view.light=sun,spot"), {warning});
  expect_words(sweep("light.angle=0,2"), {warning});
  EXPECT_EQ(sweep("shadow.resolution=256,512").find(warning), std::string::npos);
}

TEST_F(Answers, An_AO_that_draws_nothing_is_no_optimum) {
  const ProgramResult result = run_program({"sweep", "corner", "--vary", "ao.radius=0.02%,0.03%", "--size", "96x54",
                                            "--truth.spp", "64", "--no-figures", "-o", folder_ / "out"});
  expect_words(result.out, {"warning: no AO at all would be about as close to the reference"});
}

TEST_F(Answers, A_sweep_names_every_technique_with_the_least_error) {
  const ProgramResult result =
      run_program({"sweep", "contact-box", "--light", "sun", "--vary", "shadow.technique=pcss,vsm,pcf", "--size",
                   "96x54", "--no-figures", "-o", folder_ / "out"});
  expect_words(result.out, {"at shadow.technique pcss; equal at shadow.technique pcf"});
  expect_words(result.err, {"sun has no extent, so that pcss reads its map like pcf with filter nearest"});
}

}  // namespace
}  // namespace umbrameter
