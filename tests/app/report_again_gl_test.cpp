// `report` on one run: the very page of the run, from what is stored alone.
#include "tests/app/gl_run.h"
#include "tests/support/expect_words.h"

namespace umbrameter {
namespace {

class ReportAgain : public GlRun {
 protected:
  std::string out(const std::vector<std::string>& arguments) const {
    const ProgramResult result = run_program(words(words(arguments, small), {"-o", folder_ / "out"}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return folder_ / "out";
  }
};

TEST_F(ReportAgain, Of_compare_is_its_page_with_everything_that_a_run_can_measure) {
  const std::string run =
      out({"compare", "contact-box", "--measure", "image", "--shading.path", "deferred", "--overlay", "shadow-map",
           "--ao-stages", "--shimmer", "--run.metrics", "ssim,edge-roughness", "--full-images"});
  expect_same_page_in_report(run, folder_ / "again", {"overlay.svg", "cause_image.png", "ao_stages.svg"});
}

TEST_F(ReportAgain, Of_an_area_light_without_causes_is_its_page) {
  expect_same_page_in_report(out({"compare", "two-occluders", "--light", "sun", "--light.angle", "4"}),
                             folder_ / "again", {"error_visibility_sun.svg"});
}

TEST_F(ReportAgain, Of_a_sweep_of_the_bias_is_its_page_with_formula_and_images_of_cells) {
  const std::string run = out({"sweep", "tilted-plane", "--vary", "shadow.constant-bias=0:0.2:9", "--vary",
                               "shadow.resolution=128,256,512", "--vary", "shadow.filter=nearest,box"});
  expect_same_page_in_report(run, folder_ / "again", {"formula.svg", "mae_lines_0.svg"});
}

TEST_F(ReportAgain, Of_a_tuning_is_its_page_with_the_images_of_both_points) {
  const std::string run = out({"tune", "corner", "--vary", "shadow.constant-bias=0:8texels", "--vary",
                               "shadow.filter=nearest,box", "--over", "view.light=all", "--evaluations", "8"});
  expect_same_page_in_report(run, folder_ / "again", {"best_error_visibility_sun.png"});
  const ProgramResult itself = run_program({"report", run, "-o", run, "--force"});
  EXPECT_EQ(itself.exit_code, 2) << "its files would be removed";
  EXPECT_TRUE(std::filesystem::exists(run + "/tuned.toml"));
}

// The map is the same, and the mean size of its texels is summed up over other pixels.
TEST_F(ReportAgain, Of_two_cameras_does_not_call_equal_texels_different) {
  std::vector<std::string> report = {"report"};
  for (const char* camera : {"overview", "back-row"}) {
    report.push_back(folder_ / camera);
    const ProgramResult run =
        run_program({"compare", "contact-box", "-o", report.back(), "--camera", camera, "--light", "sun", "--measure",
                     "visibility", "--size", "320x180", "--no-figures", "--quiet"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  ASSERT_EQ(run_program(words(report, {"-o", folder_ / "both"})).exit_code, 0);
  EXPECT_EQ(text_of(folder_ / "both/index.html").find("texels differ in size"), std::string::npos);
}

TEST_F(ReportAgain, Of_an_exact_reference_names_no_rays) {
  std::vector<std::string> report = {"report"};
  for (const char* bias : {"1texels", "2texels"}) {
    report.push_back(folder_ / bias);
    const ProgramResult run =
        run_program({"compare", "contact-box", "-o", report.back(), "--light", "sun", "--shadow.constant-bias", bias,
                     "--truth.spp", "16", "--size", "320x180", "--no-figures", "--quiet"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  const std::string out = run_program(words(report, {"-o", folder_ / "both"})).out;
  EXPECT_EQ(out.substr(0, out.find('\n')).find("rays"), std::string::npos) << out;
  expect_words(out, {"sun, 1texels: error ", " % (95 % interval, over parts of the image)\n",
                     " % (95 % interval, over parts of the image and rays)"});
}

TEST_F(ReportAgain, Of_two_runs_says_what_was_measured_and_with_which_technique) {
  std::vector<std::string> report = {"report"};
  for (const char* filter : {"nearest", "box"}) {
    report.push_back(folder_ / filter);
    const ProgramResult run = run_program(
        words(words({"compare", "contact-box", "--measure", "visibility", "--shadow.filter", filter}, small),
              {"-o", report.back()}));
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  const ProgramResult shown = run_program(words(report, {"-o", folder_ / "both"}));
  ASSERT_EQ(shown.exit_code, 0) << shown.err;
  const std::string page = text_of(folder_ / "both/index.html");
  const std::string one = text_of(report[1] + "/index.html");
  const std::size_t subtitle = one.find("<p class=\"subtitle\">") + 20;
  const std::string view = one.substr(subtitle, one.find('<', subtitle) - subtitle);
  EXPECT_NE(page.find("<p class=\"subtitle\">nearest, box: " + view + "<"), std::string::npos) << view;
  for (const char* technique : {"texels, nearest filter, constant bias", "texels, box filter, constant bias"}) {
    EXPECT_NE(page.find(technique), std::string::npos) << technique;
  }
  EXPECT_NE(page.find("All others are equal; the page of each run lists them"), std::string::npos);
  EXPECT_EQ(page.find("a different length"), std::string::npos);
}

TEST_F(ReportAgain, Of_two_resolutions_says_that_a_bias_in_texels_is_another_length_in_each) {
  const auto page_of = [&](const std::string& bias) {
    std::vector<std::string> report = {"report"};
    for (const std::string resolution : {"64", "128"}) {
      report.push_back(folder_ / (bias + resolution));
      EXPECT_EQ(
          run_program(words({"compare", "contact-box", "--light", "sun", "--measure", "visibility", "--no-figures",
                             "--shadow.resolution", resolution, "--shadow.constant-bias", bias, "-o", report.back()},
                            small))
              .exit_code,
          0);
    }
    EXPECT_EQ(run_program(words(report, {"-o", folder_ / (bias + "both")})).exit_code, 0);
    return text_of(folder_ / (bias + "both/index.html"));
  };
  const char* text = "the same bias in texels can be a different length.";
  EXPECT_NE(page_of("1.5texels").find(text), std::string::npos);
  EXPECT_EQ(page_of("0.02").find(text), std::string::npos);
}

TEST_F(ReportAgain, The_title_of_a_tuning_over_two_scenes_names_both) {
  const std::string run = out({"tune", "corner", "contact-box", "--vary", "shadow.constant-bias=0:8texels",
                               "--evaluations", "4", "--no-figures"});
  EXPECT_NE(text_of(run + "/index.html").find("<h1>corner and contact-box: tuning</h1>"), std::string::npos);
}

TEST_F(ReportAgain, Names_a_damaged_value_and_shows_that_of_another_version_from_its_layers) {
  const std::string run = out({"compare", "contact-box", "--measure", "visibility", "--no-figures"});
  const std::string path = run + "/run.bin";
  const std::string whole = text_of(path);
  std::string damaged = whole;
  damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 4);
  put_text(path, damaged);
  const ProgramResult refused = run_program({"report", run, "-o", folder_ / "again"});
  EXPECT_EQ(refused.exit_code, 4);
  EXPECT_NE(refused.err.find("run.bin: it does not match its checksum; rerun the command"), std::string::npos)
      << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "again/index.html"));

  std::string other = whole;
  other[20] = other[20] == '0' ? '1' : '0';  // in the hash of the layout of all structs
  put_text(path, other);
  const ProgramResult shown = run_program({"report", run, "-o", folder_ / "again", "--no-figures"});
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_NE(text_of(folder_ / "again/index.html").find("All statistics"), std::string::npos);
}

}  // namespace
}  // namespace umbrameter
