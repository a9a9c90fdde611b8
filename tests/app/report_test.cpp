// `report` on runs that are written here: differences whose size and interval are known, tables, and how it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <span>

#include "core/error.h"
#include "present/presentation.h"
#include "present/runs_report.h"
#include "reports/files/exr.h"
#include "tests/app/run_program.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

constexpr int side = 64;

// A run of one light whose error is `error`; every pixel is counted.
struct MadeRun {
  std::string scene = "court";
  std::string size = "64x64";
  double bias = 0.05;
  Image<float> error = Image<float>(side, side, 0.0f);
  double mae_offset = 0.0, sampling_half_width = 0.0;  // the former adds to the value that the images have
  std::size_t counted_rows = side;                     // from the top
  float variance = 0.0f;                               // of the reference in each pixel

  double mae() const {
    double sum = 0.0;
    for (const float e : std::span(error.pixels).first(counted_rows * side)) sum += std::abs(static_cast<double>(e));
    return sum / static_cast<double>(counted_rows * side) + mae_offset;
  }
};

Image<float> noise(unsigned seed, float scale) {
  std::mt19937 random(seed);
  Image<float> image(side, side);
  for (float& value : image.pixels) value = scale * static_cast<float>(random() % 1000) / 1000.0f;
  return image;
}

class RunsReport : public testing::Test {
 protected:
  std::string write(const std::string& name, const MadeRun& made) const {
    std::filesystem::create_directories(folder_ / name);
    Json statistics = {{"pixels", side * side}, {"mae", made.mae()}, {"lit", 0.5}, {"max_error", 1.0}};
    if (made.sampling_half_width > 0.0) {
      statistics["mae_lo"] = made.mae() - made.sampling_half_width;
      statistics["mae_hi"] = made.mae() + made.sampling_half_width;
    }
    const Json shadow = {{"light", "sun_1 & 50%"}, {"layer", "sun"}, {"index", 0}, {"statistics", statistics}};
    const Json parameters = {{"view.size", made.size}, {"shadow.constant-bias", made.bias}, {"shadow.filter", "box"}};
    const Json summary = {{"program", {{"version", "1"}}},
                          {"command", "compare"},
                          {"scene", {{"name", made.scene}}},
                          {"parameters", parameters},
                          {"shadows", Json::array({shadow})}};
    folder_.write(name + "/summary.json", summary.dump());
    LayeredImage images;
    add_layer(images, "error_visibility_sun", made.error);
    if (made.variance > 0.0f)
      add_layer(images, "truth_visibility_variance_sun", Image<float>(side, side, made.variance));
    Image<float> classes(side, side, static_cast<float>(PixelClass::not_counted));
    std::fill_n(classes.pixels.begin(), made.counted_rows * side, 0.0f);
    add_layer(images, "class_sun", classes);
    add_layer(images, "gbuffer_position", Image<vec3>(side, side, vec3(1.0f)));
    write_exr(folder_ / (name + "/images.exr"), images);
    return folder_ / name;
  }
  ComparedValue mae_of(const MadeRun& a, const MadeRun& b) const {
    const std::vector<StoredRun> runs = {read_stored_run(write("a", a)), read_stored_run(write("b", b))};
    for (const ComparedStatistic& each : compare_runs(runs)) {
      if (each.name == "mae") return each.values.at(1);
    }
    throw std::runtime_error("no mae");
  }
  std::string output() const { return folder_ / "out"; }
  TemporaryFolder folder_;
};

// Both runs share an error of 0.25 ± 0.14 a pixel; the second has 0.001 ± 0.0003 more. Unpaired, the interval of each
// is ± 1.96 · 0.14 / 64 = 0.0044, four times the difference.
TEST_F(RunsReport, A_small_difference_is_significant_where_both_runs_share_their_error) {
  MadeRun a, b;
  a.error = noise(1, 0.5f);
  b.error = a.error;
  const Image<float> more = noise(2, 0.001f);
  for (std::size_t i = 0; i < b.error.size(); ++i) b.error[i] += 0.0005f + more[i];
  const ComparedValue value = mae_of(a, b);
  EXPECT_EQ(value.verdict, Verdict::significant);
  EXPECT_EQ(value.blocks, 64u) << "8 × 8 blocks of 8 × 8 pixels";
  EXPECT_NEAR(value.difference.value, 0.001, 2e-5);
  // The standard error of a mean of 4096 uniform numbers of width 0.001: 0.001/√12/64 = 4.5e-6.
  EXPECT_NEAR(0.5 * (value.difference.upper - value.difference.lower), 1.96 * 4.5e-6, 2e-6);
}

TEST_F(RunsReport, Two_draws_of_one_noise_differ_significantly_once_in_twenty) {
  constexpr std::uint32_t pairs = 60;
  std::uint32_t significant = 0;
  double mean_half_width = 0.0;
  for (std::uint32_t pair = 0; pair < pairs; ++pair) {
    MadeRun a, b;
    a.error = noise(2 * pair + 3, 0.5f);
    b.error = noise(2 * pair + 4, 0.5f);
    const ComparedValue value = mae_of(a, b);
    significant += value.verdict == Verdict::significant ? 1 : 0;
    mean_half_width += 0.5 * (value.difference.upper - value.difference.lower) / pairs;
  }
  // Standard error √2 · 0.5/√12/64 = 0.00319, times Student's t of 63/2.25 = 28 degrees of freedom. One half width
  // scatters by 1/√56 = 13 %, the mean of 60 by 2 %.
  EXPECT_NEAR(mean_half_width, 2.048 * 0.00319, 0.0005);
  // Binomial with 60 draws of 0.05: above 8 with a probability of 0.3 %.
  EXPECT_LE(significant, 8u);
}

TEST_F(RunsReport, A_light_that_reaches_few_blocks_is_not_tested_and_that_is_said) {
  MadeRun a, b;
  a.counted_rows = b.counted_rows = 16;  // two rows of 8 blocks
  a.error = noise(7, 0.5f);
  b.error = noise(8, 0.5f);
  const ComparedValue value = mae_of(a, b);
  EXPECT_EQ(value.verdict, Verdict::no_interval);
  EXPECT_EQ(value.counted_blocks, 16u);
  const ProgramResult result = run_program({"report", write("a", a), write("b", b), "-o", output(), "--no-figures"});
  EXPECT_NE(result.out.find("(not tested: counted pixels in 16 blocks of the image, 20 are needed)"), std::string::npos)
      << result.out;
}

TEST_F(RunsReport, Without_images_that_give_the_statistic_the_interval_of_the_rays_is_no_test) {
  MadeRun a, b;
  a.error = noise(5, 0.2f);
  b.error = a.error;
  b.mae_offset = 0.05;
  EXPECT_EQ(mae_of(a, b).verdict, Verdict::no_interval);
  b.mae_offset = 1e-15;
  EXPECT_EQ(mae_of(a, b).verdict, Verdict::equal) << "rounding of a sum is no difference";
  a.mae_offset = 0.2;
  b.mae_offset = 0.05;
  a.sampling_half_width = 0.03;
  b.sampling_half_width = 0.04;
  const ComparedValue value = mae_of(a, b);
  EXPECT_EQ(value.blocks, 0u);
  EXPECT_EQ(value.interval, IntervalOf::rays);
  EXPECT_EQ(value.verdict, Verdict::rays_only) << "other pixels could give another order";
  EXPECT_NEAR(value.difference.upper - value.difference.value, 0.05, 1e-9) << "√(0.03² + 0.04²)";
  const ProgramResult result = run_program({"report", write("a", a), write("b", b), "-o", output(), "--no-figures"});
  EXPECT_NE(result.out.find(" % (95 % interval, over the rays only)"), std::string::npos) << result.out;
}

// An error in patches of 8 × 8 pixels has 64 independent values, not 4096.
TEST_F(RunsReport, An_interval_does_not_take_neighbouring_pixels_for_independent) {
  MadeRun a;
  std::mt19937 random(11);
  std::vector<float> patches(64);
  for (float& patch : patches) patch = random() % 2 == 0 ? 1.0f : 0.0f;
  for (std::size_t i = 0; i < a.error.size(); ++i) a.error[i] = patches[i / side / 8 * 8 + i % side / 8];
  const std::vector<StoredRun> runs = {read_stored_run(write("a", a))};
  for (const ComparedStatistic& each : compare_runs(runs)) {
    // √(p (1 − p) / 64) with p near ½ is 0.0625; of 4096 pixels it would be 0.0078. The products of neighbouring
    // patches make the half width of one draw scatter by 13 % (28 degrees of freedom).
    const double half_width = each.values.at(0).half_width;
    if (each.name == "mae") {
      EXPECT_NEAR(half_width, 2.048 * 0.0625, 0.034);
    } else if (each.name == "max_error") {
      EXPECT_EQ(half_width, 0.0) << "a maximum is no mean";
    }
  }
}

TEST_F(RunsReport, A_difference_that_is_not_shown_to_be_significant_is_in_parentheses) {
  MadeRun a, b;
  a.error = noise(5, 0.2f);
  b.error = a.error;
  a.mae_offset = 0.1;
  b.mae_offset = 0.15;
  const auto difference = [&](double half_width) {
    a.sampling_half_width = b.sampling_half_width = half_width;
    const std::vector<StoredRun> runs = {read_stored_run(write("a", a)), read_stored_run(write("b", b))};
    return to_string(part_tables(runs, compare_runs(runs)).at(0).differences.rows.at(0).at(1));
  };
  EXPECT_EQ(difference(0.0), "(5.00)");
  EXPECT_EQ(difference(0.1), "(5 ± 14*)");
  EXPECT_EQ(difference(0.01), "(5.0 ± 1.4*)") << "the interval covers the rays alone";
}

TEST_F(RunsReport, Another_reference_is_said_only_of_what_both_runs_measured) {
  const StoredRun base = read_stored_run(write("a", {}));
  StoredRun soft = base;
  soft.parameters.emplace_back("light.radius", "1");
  EXPECT_EQ(limits_of_comparison({base, soft}).size(), 1u);
  for (MeasuredStatistic& each : soft.statistics) each.light = "another";
  for (const std::string& limit : limits_of_comparison({base, soft}))
    EXPECT_EQ(limit.find("another reference"), std::string::npos) << limit;
}

// An interval of pixels may end at 0, which no ray shortens.
TEST_F(RunsReport, Noise_is_not_blamed_for_an_interval_that_ends_at_0) {
  MadeRun a;
  a.error = Image<float>(side, side, 0.0f);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) a.error.at(x, y) = 0.5f;  // in one block alone
  }
  a.variance = 1e-8f;
  const std::string out = run_program({"report", write("a", a), write("b", a), "-o", output(), "--no-figures"}).out;
  EXPECT_NE(out.find(" (0.0 to "), std::string::npos) << out;
  EXPECT_EQ(out.find("the noise of its sampled reference"), std::string::npos) << out;
}

TEST_F(RunsReport, Equal_runs_are_equal) {
  MadeRun a, b;
  a.error = noise(6, 0.25f);
  EXPECT_EQ(mae_of(a, a).verdict, Verdict::equal);
  std::ranges::reverse_copy(a.error.pixels, b.error.pixels.begin());
  EXPECT_EQ(mae_of(a, b).verdict, Verdict::not_significant) << "other errors of the same mean";
}

TEST_F(RunsReport, Writes_page_rows_figures_and_tables_and_names_only_the_parameters_that_differ) {
  MadeRun a, b;
  a.error = noise(7, 0.5f);
  b.error = noise(8, 0.1f);
  b.bias = 0.1;
  const ProgramResult result = run_program(
      {"report", write("before", a), write("after", b), "-o", output(), "--latex", "--figure-style", "column"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("after: error"), std::string::npos) << result.out;
  const std::string page = text_of(output() + "/index.html");
  EXPECT_NE(page.find("shadow.constant-bias"), std::string::npos);
  EXPECT_EQ(page.find("shadow.filter"), std::string::npos) << "it is the same in both";
  EXPECT_NE(page.find("<a href=\"comparison.csv\">"), std::string::npos);
  EXPECT_NE(page.find(">mean absolute error</th>"), std::string::npos) << "heads are words";
  EXPECT_NE(text_of(output() + "/comparison.csv").find("significant"), std::string::npos);
  for (const char* file : {"error_visibility_sun_1.pdf", "error_visibility_sun_2.svg", "class_sun_1.png"}) {
    EXPECT_TRUE(std::filesystem::exists(output() + "/figures/" + file)) << file;
  }
  const std::string table = text_of(output() + "/figures/shadow_sun.tex");
  EXPECT_NE(table.find("\\toprule"), std::string::npos) << table;
  EXPECT_NE(table.find("Error {[}\\%{]} & before & after"), std::string::npos) << table;
  EXPECT_NE(table.find("Mean absolute error & "), std::string::npos) << table;
  const std::string differences = text_of(output() + "/figures/shadow_sun_difference.tex");
  // 25 % of noise against 5 %.
  EXPECT_NE(differences.find("{*} \\\\"), std::string::npos) << differences;
  EXPECT_NE(differences.find("$\\pm$ 95 \\% interval; {*} significant"), std::string::npos) << differences;
  for (const std::string& text : {table, differences}) EXPECT_EQ(text.find("---"), std::string::npos) << text;
}

TEST_F(RunsReport, Of_equal_runs_there_is_no_table_of_differences_and_three_stand_in_a_row) {
  MadeRun made;
  made.error = noise(7, 0.5f);
  const ProgramResult result =
      run_program({"report", write("one", made), write("two", made), write("three", made), "-o", output(), "--latex"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(output() + "/figures/shadow_sun.tex"));
  EXPECT_FALSE(std::filesystem::exists(output() + "/figures/shadow_sun_difference.tex"));
  const std::string page = text_of(output() + "/index.html");
  EXPECT_NE(page.find("class=\"figures threes\""), std::string::npos);
  EXPECT_NE(page.find("All runs have the same errors."), std::string::npos);
  EXPECT_EQ(page.find("Difference to the run"), std::string::npos);
}

TEST_F(RunsReport, The_region_of_most_error_can_be_drawn_enlarged) {
  MadeRun made;
  made.error.at(40, 50) = 1.0f;
  const ProgramResult result = run_program({"report", write("run", made), "-o", output(), "--inset", "worst"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string page = text_of(output() + "/index.html");
  // An eighth of 64 pixels; the first that holds the wrong one.
  EXPECT_NE(page.find("Inset: the region of most error, 8×8 pixels at (33, 43)."), std::string::npos) << page;
}

TEST_F(RunsReport, Two_reports_of_the_same_runs_are_equal) {
  MadeRun a, b;
  a.error = noise(9, 0.5f);
  b.error = noise(10, 0.5f);
  const std::string first = write("a", a), second = write("b", b);
  for (const char* out : {"one", "two"}) {
    ASSERT_EQ(run_program({"report", first, second, "-o", folder_ / out, "--latex"}).exit_code, 0);
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "one")) {
    if (!entry.is_regular_file() || entry.path().filename().string().starts_with(".")) continue;
    const std::filesystem::path other = folder_ / "two" / std::filesystem::relative(entry.path(), folder_ / "one");
    EXPECT_TRUE(text_of(entry.path()) == text_of(other)) << entry.path();
  }
}

TEST_F(RunsReport, Refuses_what_cannot_be_compared_and_says_what) {
  MadeRun a, other_scene, other_size;
  other_scene.scene = "forest";
  other_size.size = "32x32";
  const std::string base = write("a", a);
  const ProgramResult scenes = run_program({"report", base, write("scene", other_scene), "-o", output()});
  EXPECT_EQ(scenes.exit_code, 2);
  EXPECT_NE(scenes.err.find("'forest'"), std::string::npos) << scenes.err;
  EXPECT_TRUE(is_one_line(scenes.err)) << scenes.err;
  const ProgramResult none = run_program({"report", base, folder_.path().string(), "-o", output()});
  EXPECT_EQ(none.exit_code, 4);
  EXPECT_TRUE(is_one_line(none.err)) << none.err;
  std::filesystem::create_directories(folder_ / "newer");
  folder_.write("newer/summary.json", R"({"schema_version": 3})");
  const ProgramResult newer = run_program({"report", base, folder_ / "newer", "-o", output()});
  EXPECT_EQ(newer.exit_code, 4);
  EXPECT_NE(newer.err.find("a later version of umbrameter"), std::string::npos) << newer.err;
  EXPECT_TRUE(is_one_line(newer.err)) << newer.err;
  EXPECT_EQ(run_program({"report", base, "-o", base}).exit_code, 2);
  EXPECT_EQ(run_program({"report", base, "-o", output(), "--inset", "60,60,8,8"}).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(output())) << "nothing is written";
  const ProgramResult sizes = run_program({"report", base, write("size", other_size), "-o", output()});
  EXPECT_EQ(sizes.exit_code, 0) << sizes.err;
  EXPECT_NE((sizes.out + sizes.err).find("no difference is paired"), std::string::npos) << sizes.out << sizes.err;
}

TEST(ReportText, Values_have_the_digits_that_their_interval_justifies) {
  EXPECT_EQ(with_half_width(2.17704, 0.0372), "2.177 ± 0.037");
  EXPECT_EQ(with_half_width(-12.3, 1.26), "−12.3 ± 1.3");
  EXPECT_EQ(with_half_width(1234.5, 56.0), "1235 ± 56") << "halves are rounded up";
  EXPECT_EQ(with_half_width(0.026831, 0.0), "0.0268");
  EXPECT_EQ(with_half_width(189110.0, 0.0), "189110");
  EXPECT_EQ(with_half_width(std::nan(""), 0.0), "—");
}

// Printed in grey, causes differ in lightness and in hatching; 5 steps of CIE L* can be seen side by side.
TEST(ClassPalette, Classes_differ_in_lightness_and_causes_in_hatching) {
  for (const std::vector<CategoryColor>& palette : {class_colors(), image_cause_colors()}) {
    for (std::size_t i = 0; i < palette.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GE(std::abs(lightness(palette[i].color) - lightness(palette[j].color)), 5.0)
            << palette[i].name << " and " << palette[j].name;
        const bool are_dark = lightness(palette[i].color) < 75.0 && lightness(palette[j].color) < 75.0;
        if (are_dark) {
          EXPECT_NE(palette[i].hatch, palette[j].hatch) << palette[i].name << " and " << palette[j].name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace umbrameter
