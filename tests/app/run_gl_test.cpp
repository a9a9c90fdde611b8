// Whole runs: what is written, that it repeats, and that it does not depend on threads.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

struct Run : GlRun {};

TEST_F(Run, Compare_writes_every_file_and_layer_of_the_contract) {
  const ProgramResult result =
      run_program(words({"compare", "contact-box", "-o", folder_ / "out", "--light", "sun", "--json"}, small));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const Json summary = Json::parse(result.out);
  EXPECT_EQ(summary, Json::parse(text_of(folder_ / "out/summary.json")));
  for (const char* file : {"experiment.toml", "summary.json", "index.html", "images.exr", "figures/truth_ao.png",
                           "figures/error_visibility_sun.svg", "figures/class_sun.pdf"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / (std::string("out/") + file))) << file;
  }
  const std::set<std::string> expected = {"R",
                                          "G",
                                          "B",
                                          "A",
                                          "Z",
                                          "truth_visibility_sun.Y",
                                          "raster_visibility_sun.Y",
                                          "error_visibility_sun.Y",
                                          "class_sun.Y",
                                          "truth_ao.Y",
                                          "truth_ao_samples.Y",
                                          "truth_ao_variance.Y",
                                          "truth_ao_standard_error.Y",
                                          "raster_ao.Y",
                                          "error_ao.Y",
                                          "gbuffer_position.X",
                                          "gbuffer_position.Y",
                                          "gbuffer_position.Z",
                                          "gbuffer_normal.X",
                                          "gbuffer_normal.Y",
                                          "gbuffer_normal.Z"};
  EXPECT_EQ(channel_names(folder_ / "out/images.exr"), expected);
  const Json& statistics = summary["shadows"][0]["statistics"];
  const double sum = statistics["acne"].get<double>() + statistics["false_occlusion"].get<double>() +
                     statistics["peter_panning"].get<double>() + statistics["leak"].get<double>();
  EXPECT_NEAR(statistics["mae"].get<double>(), sum, 1e-6);
}

// Channel of that name, by pixel.
const Image<float>& channel_of(const LayeredImage& image, const std::string& name) {
  for (const Channel& channel : image.channels) {
    if (channel.name == name) return channel.values;
  }
  throw std::runtime_error("no channel " + name);
}

TEST_F(Run, Background_pixels_have_no_position) {
  ASSERT_EQ(run_program(words({"raster", "spheres", "-o", folder_ / "out"}, small)).exit_code, 0);
  const LayeredImage image = read_exr(folder_ / "out/images.exr");
  const Image<float>& alpha = channel_of(image, "A");
  std::size_t background = 0;
  for (const char* axis : {"gbuffer_position.X", "gbuffer_position.Y", "gbuffer_position.Z"}) {
    const Image<float>& position = channel_of(image, axis);
    for (std::size_t i = 0; i < position.size(); ++i) {
      ASSERT_EQ(std::isnan(position[i]), alpha[i] == 0.0f) << axis << " " << i;
      background += alpha[i] == 0.0f ? 1u : 0u;
    }
  }
  EXPECT_GT(background, 0u);
}

// A triangle under a sun of that name.
std::string scene_with_light_named(const std::string& name) {
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],"scene":0,"scenes":[{"nodes":[0,1]}],)"
         R"("nodes":[{"mesh":0},{"rotation":[-0.7071067811865476,0,0,0.7071067811865476],)"
         R"("extensions":{"KHR_lights_punctual":{"light":0}}}],)"
         R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional","name":")" +
         name +
         R"("}]}},"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,)"
         R"("componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
         // Corners at the origin, at x = 1 and at y = 1.
         R"("buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
         R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

TEST_F(Run, The_summary_has_the_light_s_own_name_and_its_layer) {
  folder_.write("named.gltf", scene_with_light_named("sun-60"));
  const ProgramResult result = run_program(
      words({"raster", folder_ / "named.gltf", "-o", folder_ / "out", "--light", "SUN-60", "--json"}, small));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json shadow = Json::parse(result.out)["shadows"][0];
  EXPECT_EQ(shadow["light"], "sun-60");
  EXPECT_EQ(shadow["layer"], "sun_60");
  EXPECT_TRUE(channel_names(folder_ / "out/images.exr").contains("raster_visibility_sun_60.Y"));
}

TEST_F(Run, A_light_with_a_name_of_300_characters_can_be_measured) {
  const std::string name(300, 'x');
  folder_.write("long.gltf", scene_with_light_named(name));
  const ProgramResult result =
      run_program(words({"raster", folder_ / "long.gltf", "-o", folder_ / "out", "--json"}, small));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out)["shadows"][0]["light"], name);
  EXPECT_TRUE(std::filesystem::exists(folder_ / ("out/figures/raster_visibility_" + std::string(64, 'x') + ".png")));
}

TEST_F(Run, A_dry_run_of_a_sweep_counts_cells_and_groups_and_estimates_the_time) {
  const ProgramResult result =
      run_program(words({"sweep", "contact-box", "--dry-run", "-o", folder_ / "out", "--light", "sun", "--vary",
                         "shadow.constant-bias=0:0.1:11", "--vary", "shadow.resolution=64,128,256"},
                        small));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("cells      33\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("groups     3 of at most 11 cells"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(" trial measurements"), std::string::npos) << result.out;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(Run, The_error_layer_is_raster_less_truth_in_every_pixel) {
  ASSERT_EQ(run_program(words({"compare", "contact-box", "-o", folder_ / "out", "--light", "sun"}, small)).exit_code,
            0);
  const LayeredImage image = read_exr(folder_ / "out/images.exr");
  const auto layer = [&](const std::string& name) {
    for (const Channel& channel : image.channels) {
      if (channel.name == name) return channel.values;
    }
    return Image<float>();
  };
  const Image<float> raster = layer("raster_visibility_sun.Y");
  const Image<float> truth = layer("truth_visibility_sun.Y");
  const Image<float> error = layer("error_visibility_sun.Y");
  ASSERT_EQ(error.size(), 96u * 54u);
  for (std::size_t i = 0; i < error.size(); ++i) ASSERT_EQ(error[i], raster[i] - truth[i]);
}

TEST_F(Run, Equal_runs_give_equal_bytes_at_any_number_of_threads) {
  const auto run = [&](const std::string& name, const std::string& threads) {
    const ProgramResult result = run_program(words({"compare", "courtyard", "-o", folder_ / name, "--threads", threads,
                                                    "--shadow.resolution", "256", "--no-figures"},
                                                   small));
    ASSERT_EQ(result.exit_code, 0) << result.err;
  };
  run("one", "1");
  run("two", "2");
  run("again", "2");
  for (const char* file : {"images.exr", "summary.json", "experiment.toml", "run.bin"}) {
    EXPECT_EQ(text_of(folder_ / (std::string("one/") + file)), text_of(folder_ / (std::string("two/") + file))) << file;
    EXPECT_EQ(text_of(folder_ / (std::string("two/") + file)), text_of(folder_ / (std::string("again/") + file)))
        << file;
  }
}

TEST_F(Run, A_stored_experiment_repeats_its_run) {
  ASSERT_EQ(run_program(words({"sweep", "contact-box", "-o", folder_ / "first", "--light", "0", "--vary",
                               "shadow.constant-bias=0:0.1:5", "--vary", "shadow.resolution=128,256"},
                              small))
                .exit_code,
            0);
  const ProgramResult again =
      run_program({"sweep", "-c", folder_ / "first/experiment.toml", "-o", folder_ / "second", "--quiet"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  for (const char* file : {"sweep.csv", "experiment.toml", "images.exr"}) {
    EXPECT_EQ(text_of(folder_ / (std::string("first/") + file)), text_of(folder_ / (std::string("second/") + file)))
        << file;
  }
}

TEST_F(Run, A_sweep_names_its_axes_in_full_and_has_a_row_for_each_cell) {
  ASSERT_EQ(run_program(words({"sweep", "contact-box", "-o", folder_ / "out", "--light", "0", "--vary",
                               "shadow.constant-bias=0:0.1:5", "--vary", "shadow.resolution=128,256"},
                              small))
                .exit_code,
            0);
  const std::string csv = text_of(folder_ / "out/sweep.csv");
  EXPECT_EQ(csv.rfind("shadow.constant-bias,shadow.resolution,pixels,lit,blocked,mae,rmse,acne,false_occlusion,"
                      "peter_panning,leak,",
                      0),
            0u)
      << csv.substr(0, 200);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 5 * 2);
}

TEST_F(Run, A_sweep_cell_equals_a_run_of_its_own) {
  ASSERT_EQ(run_program(words({"sweep", "contact-box", "-o", folder_ / "sweep", "--light", "0", "--vary",
                               "shadow.constant-bias=0.01,0.05", "--vary", "shadow.resolution=128"},
                              small))
                .exit_code,
            0);
  ASSERT_EQ(run_program(words({"compare", "contact-box", "-o", folder_ / "one", "--light", "0",
                               "--shadow.constant-bias", "0.05", "--shadow.resolution", "128"},
                              small))
                .exit_code,
            0);
  const Json summary = Json::parse(text_of(folder_ / "one/summary.json"));
  const std::string csv = text_of(folder_ / "sweep/sweep.csv");
  const std::string last = csv.substr(csv.rfind('\n', csv.size() - 2) + 1);
  const Json& statistics = summary["shadows"][0]["statistics"];
  std::string expected = "0.05,128,";
  expected += statistics["pixels"].dump();
  EXPECT_EQ(last.rfind(expected + ",", 0), 0u) << last;
  std::string mae = ",";
  mae += statistics["mae"].dump();
  EXPECT_NE(last.find(mae + ","), std::string::npos) << last << statistics;
}

// The columns of a sweep's rows, by name.
std::vector<std::map<std::string, double>> rows_of(const std::string& csv) {
  std::vector<std::map<std::string, double>> rows;
  std::istringstream lines(csv);
  std::string line;
  std::vector<std::string> names;
  while (std::getline(lines, line)) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::istringstream cells(line);
    std::string cell;
    std::map<std::string, double> row;
    for (std::size_t i = 0; std::getline(cells, cell, ','); ++i) {
      if (rows.empty() && row.empty() && names.size() <= i) {
        names.push_back(cell);
      } else {
        row[names.at(i)] = std::stod(cell);
      }
    }
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

TEST_F(Run, Acne_on_the_tilted_plane_follows_its_formula) {
  // Share of an unbounded lit plane, one nearest tap; p ≥ q the larger and smaller of |cos ψ|, |sin ψ| and
  // s = b/(t tan θ): s ≤ (p−q)/2: ½ − s/p; up to (p+q)/2: ((p+q)/2 − s)²/(2pq); above: 0.
  struct Sun {
    const char* light;
    double theta;
    double psi;
  };
  constexpr double degree = 3.14159265358979323846 / 180.0;
  for (const Sun& sun : {Sun{"sun-30", 30 * degree, 0}, Sun{"sun-60", 60 * degree, 0}, Sun{"sun-75", 75 * degree, 0},
                         Sun{"sun-60-azimuth-45", 60 * degree, 45 * degree}}) {
    const ProgramResult result = run_program(
        {"sweep", "tilted-plane", "-o", folder_ / sun.light, "--light", sun.light, "--size", "640x360", "--quiet",
         "--no-figures", "--vary", "shadow.constant-bias=0:0.12:7", "--vary", "shadow.resolution=256,400,1024"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const double p = std::max(std::cos(sun.psi), std::sin(sun.psi));
    const double q = std::min(std::cos(sun.psi), std::sin(sun.psi));
    const auto rows = rows_of(text_of(folder_ / sun.light / "sweep.csv"));
    ASSERT_EQ(rows.size(), 21u);
    for (const auto& row : rows) {
      const double s = row.at("shadow.constant-bias") / (row.at("mean_texel") * std::tan(sun.theta));
      double share = 0.0;
      if (s <= (p - q) / 2) {
        share = 0.5 - s / p;
      } else if (s <= (p + q) / 2) {
        share = std::pow((p + q) / 2 - s, 2) / (2 * p * q);
      }
      // 230,400 pixels: the standard error of as many independent samples is at most 0.00104.
      EXPECT_NEAR(row.at("acne"), share, 0.00104)
          << sun.light << ", bias " << row.at("shadow.constant-bias") << ", resolution " << row.at("shadow.resolution");
      EXPECT_EQ(row.at("pixels"), 640.0 * 360.0);
      EXPECT_NEAR(row.at("mae"), row.at("acne"), 1e-12) << "acne is the only error of a plane";
    }
  }
}

TEST_F(Run, An_ao_sweep_states_its_interval) {
  const ProgramResult result = run_program(words(
      {"sweep", "corner", "-o", folder_ / "out", "--vary", "ao.radius=0.25,0.5", "--vary", "ao.samples=8,16"}, small));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(text_of(folder_ / "out/sweep.csv").rfind("ao.radius,ao.samples,pixels,mae,mae_lo,mae_hi,", 0), 0u);
  // Values of axes stay what they are, where measured shares become per cent.
  const std::string page = text_of(folder_ / "out/index.html");
  EXPECT_NE(page.find("Cells of least error"), std::string::npos);
  EXPECT_EQ(page.find("800.0000"), std::string::npos);
  EXPECT_EQ(page.find("1600.0000"), std::string::npos);
}

TEST_F(Run, Trace_and_raster_write_the_layers_that_they_have) {
  ASSERT_EQ(run_program(words({"trace", "corner", "-o", folder_ / "trace", "--light", "0"}, small)).exit_code, 0);
  ASSERT_EQ(run_program(words({"raster", "corner", "-o", folder_ / "raster", "--light", "0"}, small)).exit_code, 0);
  const std::set<std::string> traced = channel_names(folder_ / "trace/images.exr");
  const std::set<std::string> drawn = channel_names(folder_ / "raster/images.exr");
  EXPECT_TRUE(traced.contains("truth_ao.Y") && traced.contains("truth_ao_standard_error.Y"));
  EXPECT_FALSE(traced.contains("raster_ao.Y"));
  EXPECT_TRUE(drawn.contains("raster_ao.Y"));
  EXPECT_FALSE(drawn.contains("truth_ao.Y"));
}

TEST(Trace, Stops_each_pixel_at_the_tolerance_and_writes_the_layers_asked_for) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program({"trace", "corner", "-o", folder / "out", "--size", "48x27", "--quiet", "--truth.tolerance", "0.05",
                   "--truth.min-spp", "64", "--truth.max-spp", "8192", "--truth.ao-layers", "all"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json truth = Json::parse(text_of(folder / "out/summary.json"))["ao"]["truth"];
  EXPECT_LE(truth["worst_half_width_95"], 0.05);
  EXPECT_LE(truth["mean_half_width_95"], truth["worst_half_width_95"]);
  EXPECT_EQ(truth["pixels_at_limit"], 0);
  double rays = 0.0;
  for (const Channel& channel : read_exr(folder / "out/images.exr").channels) {
    if (channel.name != "truth_ao_samples.Y") continue;
    for (const float samples : channel.values.pixels) rays += samples;
  }
  EXPECT_EQ(rays, truth["rays"]);
  const std::set<std::string> names = channel_names(folder / "out/images.exr");
  for (const char* layer : {"truth_bent_normal.X", "truth_bent_normal.Z", "truth_ao_hit_distance.Y"}) {
    EXPECT_TRUE(names.contains(layer)) << layer;
  }
}

TEST(Trace, A_falloff_without_a_distance_is_a_usage_error_that_says_what_to_set) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program(words(
      {"trace", "corner", "-o", folder / "out", "--truth.ao-falloff", "linear", "--truth.ao-distance", "0"}, small));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("truth.ao-distance"), std::string::npos) << result.err;
}

TEST(Trace, Needs_no_opengl) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program(words({"trace", "corner", "-o", folder / "out"}, small),
                                           {{"__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent.json"}, {}, 0, 0.0});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

}  // namespace
}  // namespace umbrameter
