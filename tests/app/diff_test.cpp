// `diff` on files: what it prints, which values it compares, and how it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "reports/files/exr.h"
#include "reports/files/png.h"
#include "tests/app/run_program.h"
#include "tests/support/png_bytes.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

/// Black before column x, white from it on.
std::string step_png(int x) {
  Image<glm::u8vec3> image(64, 64);
  for (int row = 0; row < 64; ++row) {
    for (int column = x; column < 64; ++column) image.at(column, row) = glm::u8vec3(255);
  }
  return to_png(image);
}

std::string constant_exr(const TemporaryFolder& folder, const std::string& name, float value, int width = 16) {
  LayeredImage file;
  for (const char* channel : {"R", "G", "B"}) file.channels.push_back({channel, Image<float>(width, 16, value)});
  add_layer(file, "ao", Image<float>(width, 16, value / 2.0f));
  write_exr(folder / name, file);
  return folder / name;
}

Json diff_json(std::vector<std::string> words) {
  words.insert(words.begin(), "diff");
  words.push_back("--json");
  const ProgramResult result = run_program(words);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return Json::parse(result.out);
}

void expect_error(std::vector<std::string> words, int exit_code, const std::string& text) {
  words.insert(words.begin(), "diff");
  const ProgramResult result = run_program(words);
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_NE(result.err.find(text), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
}

TEST(Diff, Of_a_moved_edge_has_the_published_flip) {
  const TemporaryFolder folder;
  const std::string test = folder.write("test.png", step_png(33));
  const std::string reference = folder.write("reference.png", step_png(32));
  const Json json = diff_json({test, reference, "-o", folder / "map.png"});
  EXPECT_NEAR(json["metrics"]["ldr-flip"]["score"].get<double>(), 0.051723, 1.2e-5);
  EXPECT_NEAR(json["metrics"]["ldr-flip"]["max"].get<double>(), 0.772917, 1.2e-5);
  EXPECT_EQ(json["metrics"]["mae"]["score"], 1.0 / 64.0);  // one column of 64
  EXPECT_EQ(json["metrics"]["mae"]["max_at"], (Json{32, 0}));
  EXPECT_EQ(json["metrics"]["ms-ssim"]["score"], nullptr);  // too small for five scales
  EXPECT_FALSE(json["metrics"].contains("hdr-flip"));
  EXPECT_EQ(json["map"]["metric"], "ldr-flip");
  EXPECT_EQ(from_png(text_of(folder / "map.png")).width, 64);

  const ProgramResult table = run_program({"diff", test, reference});
  EXPECT_NE(table.out.find("ldr-flip"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("32,0"), std::string::npos) << table.out;
}

TEST(Diff, Mask_and_crop_select_the_pixels_that_count) {
  const TemporaryFolder folder;
  const std::string test = folder.write("test.png", step_png(33));
  const std::string reference = folder.write("reference.png", step_png(32));
  const std::string mask = folder.write("mask.png", step_png(32));
  const Json masked = diff_json({test, reference, "--mask", mask, "--metrics", "mae"});
  EXPECT_EQ(masked["counted_pixels"], 32 * 64);
  EXPECT_EQ(masked["metrics"]["mae"]["score"], 1.0 / 32.0);
  EXPECT_EQ(masked["metrics"].size(), 1u);
  const Json cropped = diff_json({test, reference, "--crop", "30,10,4,5", "--metrics", "mae"});
  EXPECT_EQ(cropped["counted_pixels"], 20);
  EXPECT_EQ(cropped["metrics"]["mae"]["score"], 0.25);
  EXPECT_EQ(cropped["metrics"]["mae"]["max_at"], (Json{2, 0}));
}

TEST(Diff, Reads_exr_files_as_linear_and_their_layers_by_name) {
  const TemporaryFolder folder;
  const std::string test = constant_exr(folder, "test.exr", 0.5f);
  const std::string reference = constant_exr(folder, "reference.exr", 2.0f);
  const Json json = diff_json({test, reference, "--exposures", "-2:1:3"});
  EXPECT_EQ(json["values"], "linear");
  EXPECT_EQ(json["metrics"]["mae"]["score"], 1.5);
  EXPECT_EQ(json["metrics"]["hdr-flip"]["start_exposure"], -2.0);
  EXPECT_EQ(json["metrics"]["hdr-flip"]["exposures"], 3.0);
  // A display clips 2 to white: the metrics of displayed images see 0.5 against 1, at −1 EV 0.25 against 1.
  EXPECT_NEAR(json["metrics"]["psnr"]["score"].get<double>(), -20.0 * std::log10(1.0 - 0.735357), 1e-4);
  const Json layer = diff_json({test, reference, "--layer", "ao", "--data", "--metrics", "mae,psnr"});
  EXPECT_EQ(layer["metrics"]["mae"]["score"], 0.75);
  EXPECT_NEAR(layer["metrics"]["psnr"]["score"].get<double>(), -20.0 * std::log10(0.75), 1e-9);
}

TEST(Diff, Says_that_a_file_with_layers_has_others_and_that_edges_need_a_mask) {
  const TemporaryFolder folder;
  const std::string grey = constant_exr(folder, "grey.exr", 0.25f);
  constexpr const char* other_layers = "channels R, G, B: --layer selects another layer";
  EXPECT_NE(run_program({"diff", grey, grey}).out.find(other_layers), std::string::npos);
  EXPECT_EQ(run_program({"diff", grey, grey, "--layer", "ao"}).out.find(other_layers), std::string::npos);
  const std::string black = folder.write("black.png", to_png(Image<glm::u8vec3>(64, 64)));
  const std::string step = folder.write("step.png", step_png(32));
  constexpr const char* few = "note: few edges pass from below 0.1 to above 0.9 in both images";
  EXPECT_NE(run_program({"diff", black, step}).out.find(few), std::string::npos);
  EXPECT_EQ(run_program({"diff", step, step}).out.find(few), std::string::npos);
  // Without edges-found, too: a mean over few points reads as perfect.
  EXPECT_NE(run_program({"diff", black, step, "--metrics", "edge-displacement"}).out.find(few), std::string::npos);
}

TEST(Diff, Warns_that_a_figure_of_a_run_has_other_pixels_than_were_measured) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "figures");
  const std::string step = folder.write("figures/raster_ao.png", step_png(32));
  EXPECT_EQ(run_program({"diff", step, step}).out.find("warning"), std::string::npos) << "no run";
  folder.write("images.exr", "");
  const std::string out = run_program({"diff", step, step}).out;
  EXPECT_NE(out.find("warning: TEST is a figure of a run"), std::string::npos) << out;
  EXPECT_NE(out.find("images.exr with --layer"), std::string::npos) << out;
}

TEST(Diff, Says_how_many_edge_points_count_in_the_reference) {
  const TemporaryFolder folder;
  // In the upper half from black to white, in the lower half to a grey below 0.9, where none counts.
  Image<glm::u8vec3> image(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 32; x < 64; ++x) image.at(x, y) = glm::u8vec3(y < 32 ? 255 : 200);
  }
  const std::string step = folder.write("step.png", to_png(image));
  const Json found = diff_json({step, step, "--metrics", "edges-found"})["metrics"]["edges-found"];
  EXPECT_EQ(found["score"], 1.0);
  EXPECT_EQ(found["edge points of REFERENCE"], 64.0);
  EXPECT_EQ(found["share of these that counts in REFERENCE"], 0.5);
}

TEST(Diff, Says_which_colour_space_it_assumed) {
  const TemporaryFolder folder;
  const std::string grey = folder.write("grey.png", png_bytes(1, 1, 16, 0, std::string("\0\xbc\xbc", 3)));
  const std::string stated = folder.write("stated.png", to_png(Image<glm::u8vec3>(1, 1, glm::u8vec3(188))));
  const Json json = diff_json({grey, stated});
  EXPECT_EQ(json["metrics"]["mae"]["score"], 0.0) << "the same picture in 16 and in 8 bits";
  EXPECT_EQ(json["test_encoding"], "sRGB, assumed");
  EXPECT_EQ(json["reference_encoding"], "sRGB");
  const std::string line = run_program({"diff", grey, stated}).out;
  EXPECT_NE(line.find("1 compared, sRGB (TEST: sRGB, assumed)\n"), std::string::npos) << line;
}

TEST(Diff, Compares_sizes_before_it_decodes_pixels) {
  const TemporaryFolder folder;
  // No pixels, but enough bytes for 16000 x 16000 of one bit: 16000² / 8 / 1032 = 31008.
  const std::string large = png_bytes(16000, 16000, 1, 0, "", png_chunk("teSt", std::string(40'000, 'x')));
  expect_error({folder.write("large.png", large), folder.write("small.png", step_png(3))}, 2,
               "its size 16000x16000 differs from the reference's 64x64");
}

// A few bytes that claim 3.6 gigapixels. Under a sanitizer the address space is no measure of memory.
TEST(Diff, A_file_that_claims_a_huge_size_is_refused_before_memory_is_asked_for) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer reserves address space";
#endif
  const TemporaryFolder folder;
  const std::string bomb = folder.write("bomb.png", png_bytes(60000, 60000, 8, 2, ""));
  const std::string small = folder.write("small.png", step_png(3));
  ProgramOptions options;
  options.wrapper = {"sh", "-c", "ulimit -v 1500000; exec \"$@\"", "sh"};  // kB
  for (const std::vector<std::string>& files : {std::vector{bomb, small}, {small, bomb}, {bomb, bomb}}) {
    const ProgramResult result = run_program({"diff", files[0], files[1]}, options);
    EXPECT_TRUE(result.exit_code == 2 || result.exit_code == 4) << result.exit_code;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_EQ(result.err.find("out of memory"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find(".png"), std::string::npos) << result.err;
  }
}

TEST(Diff, Says_nothing_of_a_map_without_values) {
  const TemporaryFolder folder;
  const std::string one = folder.write("one.png", to_png(Image<glm::u8vec3>(1, 1)));
  const ProgramResult result = run_program({"diff", one, one, "--verbose"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* odd : {"nan", "-1,-1"}) EXPECT_EQ(result.out.find(odd), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("weighted 25 %"), std::string::npos) << result.out;
}

TEST(Diff, Of_a_black_reference_and_of_equal_images_ends) {
  const TemporaryFolder folder;
  const std::string black = constant_exr(folder, "black.exr", 0.0f);
  const std::string white = constant_exr(folder, "white.exr", 1.0f);
  EXPECT_GT(diff_json({white, black})["metrics"]["hdr-flip"]["score"], 0.5);
  const Json equal = diff_json({white, white, "--exit-code"});
  EXPECT_EQ(equal["metrics"]["hdr-flip"]["weighted_median"], 0.0);
  EXPECT_EQ(equal["metrics"]["psnr"]["score"], nullptr);  // infinite
  EXPECT_EQ(run_program({"diff", white, black, "--exit-code"}).exit_code, 1);
}

// Stripes of random width and value, moved to the right.
std::string stripes_png(int shift, bool upside_down = false) {
  Image<glm::u8vec3> image(96, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 96; ++x) {
      const int row = upside_down ? 63 - y : y;
      const int block = (x - shift + 50) / 5 + 100 * (row / 7);
      image.at(x, y) = glm::u8vec3((static_cast<unsigned>(block) * 2654435761u >> 13) % 256u);
    }
  }
  return to_png(image);
}

TEST(Diff, Warns_where_the_test_image_is_moved_or_upside_down) {
  const TemporaryFolder folder;
  const std::string reference = folder.write("reference.png", stripes_png(0));
  const std::string moved = folder.write("moved.png", stripes_png(2));
  const std::string flipped = folder.write("flipped.png", stripes_png(0, true));
  EXPECT_EQ(diff_json({reference, reference})["misalignment"], nullptr);
  const Json shift = diff_json({moved, reference})["misalignment"];
  EXPECT_EQ(shift["shift_px"], (Json{2, 0}));
  EXPECT_EQ(shift["top_bottom_flip"], false);
  EXPECT_NEAR(shift["remaining_difference"].get<double>(), 0.0, 1e-6);
  const Json flip = diff_json({flipped, reference})["misalignment"];
  EXPECT_EQ(flip["shift_px"], (Json{0, 0}));
  EXPECT_EQ(flip["top_bottom_flip"], true);
  EXPECT_NE(
      run_program({"diff", moved, reference}).out.find("warning: TEST lies 2 px to the right relative to REFERENCE"),
      std::string::npos);
  EXPECT_NE(run_program({"diff", flipped, reference}).out.find("warning: TEST is upside down"), std::string::npos);
  EXPECT_EQ(run_program({"diff", reference, reference}).out.find("warning"), std::string::npos);
}

TEST(Diff, Refuses_what_it_cannot_compare_in_one_line) {
  const TemporaryFolder folder;
  const std::string a = constant_exr(folder, "a.exr", 1.0f);
  expect_error({a, constant_exr(folder, "wide.exr", 1.0f, 17)}, 2, "16x16 differs from the reference's 17x16");
  expect_error({a, folder / "missing.exr"}, 4, "missing.exr");
  expect_error({constant_exr(folder, "nan.exr", std::numeric_limits<float>::quiet_NaN()), a}, 4,
               "nan.exr: pixel (0, 0)");
  expect_error({a, folder.write("text.txt", "hello")}, 4, "text.txt");
  expect_error({a, a, "--layer", "none"}, 2, "ao.Y");
  expect_error({a, a, "--metrics", "flop"}, 2, "ldr-flip");
  expect_error({a, a, "--crop", "1,2,3"}, 2, "--crop 1,2,3");
  expect_error({a, a, "--crop", "0,0,17,1"}, 2, "leaves the image");
  expect_error({a, a, "--exposures", "3:-3"}, 2, "the start is after the stop");
  expect_error({a, a, "--exposures", "low"}, 2, "--exposures low");
  expect_error({a, a, "-o", folder / "map.jpg"}, 2, ".png");
  expect_error({a}, 2, "REFERENCE");
}

}  // namespace
}  // namespace umbrameter
