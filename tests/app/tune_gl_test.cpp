// `tune` as a program: its best point against a grid, its files, and what it does with wrong input and interrupts.
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reports/files/data.h"
#include "tests/app/gl_run.h"
#include "tests/support/expect_words.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

class Tune : public GlRun {
 protected:
  std::vector<std::string> arguments(const std::string& output, const std::vector<std::string>& more) const {
    return words({"tune", "corner", "-o", folder_ / output, "--size", "96x54", "--no-figures", "--truth.spp", "16"},
                 more);
  }
  Json tuning(const std::string& output, const std::vector<std::string>& more) const {
    const ProgramResult result = run_program(arguments(output, more));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return Json::parse(text_of(folder_ / (output + "/summary.json")))["tuning"];
  }
};

TEST_F(Tune, Of_the_bias_alone_is_at_least_as_good_as_a_grid_of_a_thousand) {
  const Json tuned = tuning("tuned", {"--light", "sun", "--vary", "shadow.constant-bias=0:0.2"});
  const std::vector<std::string> sweep = {
      "sweep",       "corner",  "-o",  folder_ / "grid", "--size",
      "96x54",       "--light", "sun", "--vary",         "shadow.constant-bias=0:0.2:1000",
      "--no-figures"};
  ASSERT_EQ(run_program(sweep).exit_code, 0);
  const Json grid = Json::parse(text_of(folder_ / "grid/summary.json"))["sweep"]["least_mae"][0];
  EXPECT_LE(tuned["best"]["cost"].get<double>(), grid["mae"].get<double>());
  // The range of good biases comes from the whole curve: the grid's own, to a step of 0.2 m / 999.
  double smallest = 1.0;
  double largest = 0.0;
  double least_away = 1.0;  // of the biases that are a twentieth of the axis from the best one
  const double best = tuned["best"]["values"]["shadow.constant-bias"];
  std::istringstream rows(text_of(folder_ / "grid/sweep.csv"));
  std::string row;
  std::getline(rows, row);
  const auto column = [&](const std::string& name) {
    const std::string before = row.substr(0, row.find("," + name + ","));
    return std::count(before.begin(), before.end(), ',') + 1;
  };
  const auto mae = column("mae");
  const auto pixels = column("pixels");
  while (std::getline(rows, row)) {
    std::istringstream cells(row);
    std::vector<double> numbers;
    for (std::string cell; std::getline(cells, cell, ',');) numbers.push_back(std::stod(cell));
    if (std::abs(numbers[0] - best) >= 0.01) least_away = std::min(least_away, numbers[static_cast<std::size_t>(mae)]);
    // Of one wrong pixel three more are chance.
    const double limit = tuned["best"]["cost"].get<double>() + 3.0 / numbers[static_cast<std::size_t>(pixels)];
    if (numbers[static_cast<std::size_t>(mae)] > limit + 1e-9) continue;
    smallest = std::min(smallest, numbers[0]);
    largest = std::max(largest, numbers[0]);
  }
  const Json& within = tuned["sensitivity"][0]["within_5_percent"];
  EXPECT_NEAR(within[0].get<double>(), smallest, 0.2 / 999);
  EXPECT_NEAR(within[1].get<double>(), largest, 0.2 / 999);
  EXPECT_EQ(tuned["evaluations"], 1);
  EXPECT_LE(tuned["runner_up"]["cost"].get<double>(), least_away + 1e-12);

  // The best point, measured as a configuration like any other, has the cost that the search found.
  const std::vector<std::string> compare = {"compare",
                                            "corner",
                                            "-o",
                                            folder_ / "again",
                                            "--size",
                                            "96x54",
                                            "--light",
                                            "sun",
                                            "--no-figures",
                                            "--shadow.constant-bias",
                                            tuned["best"]["values"]["shadow.constant-bias"].dump()};
  ASSERT_EQ(run_program(compare).exit_code, 0);
  const Json again = Json::parse(text_of(folder_ / "again/summary.json"))["shadows"][0]["statistics"];
  EXPECT_NEAR(again["mae"].get<double>(), tuned["best"]["cost"].get<double>(), 1e-12);
}

TEST_F(Tune, Says_in_words_what_was_minimised_and_how_much_better_the_best_point_is) {
  const ProgramResult result =
      run_program(arguments("words", {"--light", "sun", "--vary", "shadow.constant-bias=0:0.2"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find(" cm: mean absolute error "), std::string::npos) << result.out;
  const std::string default_line = result.out.substr(result.out.find("\ndefault"));
  EXPECT_NE(default_line.substr(0, default_line.find('\n', 1)).find("; the best point "), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("; the smallest of these has acne of at most 0.1 %"), std::string::npos) << result.out;
}

TEST_F(Tune, Says_that_a_range_and_the_best_value_reach_the_end_of_the_axis) {
  const ProgramResult result =
      run_program(arguments("end", {"--light", "sun", "--vary", "shadow.constant-bias=0:0.002"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("the best value 2 mm is the upper end of the axis"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("at most 1.05 times the least cost"), std::string::npos) << result.out;
  // In the answer and in the table.
  EXPECT_NE(result.out.find("; the range reaches the upper end of the axis"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("2 mm (upper end of the axis)"), std::string::npos) << result.out;
}

TEST_F(Tune, Says_of_which_of_several_cases_a_number_is) {
  const ProgramResult result =
      run_program({"tune", "contact-box", "-o", folder_ / "cases", "--size", "160x90", "--no-figures", "--light", "sun",
                   "--over", "view.camera=overview,front-row", "--vary", "shadow.constant-bias=0texels:8texels"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out.find("use constant-bias "), 0u) << result.out;
  expect_words(result.out, {" %, the mean of 2 cases, acne ", " in the case with the most. ", "highest cost"});
}

TEST_F(Tune, Its_range_and_its_front_say_what_the_constraints_cut) {
  const ProgramResult result =
      run_program({"tune", "courtyard", "-o", folder_ / "kept", "--size", "160x90", "--no-figures", "--over",
                   "view.camera=all", "--constraint", "acne<0.1%", "--vary", "shadow.constant-bias=0:8texels"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_words(result.out,
               {"constant bias is, of those that keep the constraints, the smallest (to three digits) whose cost is",
                "constant-bias (only biases that keep the constraints): ", " times the least cost of these (",
                " %, but breaks a constraint that the best point keeps; "});
  expect_words(text_of(folder_ / "kept/index.html"),
               {"mean absolute error, the mean of 6 cases", "acne, the mean of 6 cases"});
}

// Nearest and bilinear filters do not read the size.
TEST_F(Tune, An_axis_that_a_word_does_not_read_is_not_to_be_extended_for_it) {
  const ProgramResult result = run_program({"tune",
                                            "contact-box",
                                            "-o",
                                            folder_ / "words",
                                            "--size",
                                            "96x54",
                                            "--no-figures",
                                            "--light",
                                            "sun",
                                            "--truth.shadow",
                                            "pixel",
                                            "--truth.spp",
                                            "16",
                                            "--vary",
                                            "shadow.filter=nearest,box",
                                            "--vary",
                                            "shadow.filter-size=3,5",
                                            "--vary",
                                            "shadow.constant-bias=0:8texels",
                                            "--evaluations",
                                            "24"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out.find("shadow.filter-size: with nearest"), std::string::npos) << result.out;
}

// What is printed is what tuned.toml has, and what its error is of.
TEST_F(Tune, A_recommended_bias_has_three_digits) {
  const ProgramResult result =
      run_program({"tune", "courtyard", "-o", folder_ / "digits", "--size", "160x90", "--no-figures", "--light", "spot",
                   "--vary", "shadow.constant-bias=0:8texels"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_words(result.out, {"; of these, acne is at most 0.1 % from "});
  const Json recommended = Json::parse(text_of(folder_ / "digits/summary.json")).at("tuning").at("recommended");
  const double bias = recommended.at("values").at("shadow.constant-bias");
  EXPECT_EQ(bias, std::stod(fmt::format("{:.3g}", bias)));
  const ProgramResult again =
      run_program({"compare", "-c", folder_ / "digits/tuned.toml", "-o", folder_ / "again", "--no-figures"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const Json of_run = Json::parse(text_of(folder_ / "again/summary.json")).at("shadows").at(0).at("statistics");
  EXPECT_NEAR(of_run.at("mae").get<double>(), recommended.at("cost").get<double>(), 1e-12);
  EXPECT_TRUE(text_of(folder_ / "digits/tuned.toml").starts_with("# The recommended point of "));
}

TEST_F(Tune, A_held_out_camera_says_of_both_points_which_constraint_they_break) {
  const ProgramResult result =
      run_program({"tune", "courtyard", "-o", folder_ / "held", "--size", "160x90", "--no-figures", "--camera",
                   "overview", "--constraint", "acne<0.1%", "--vary", "shadow.constant-bias=0:8texels"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::size_t held = result.out.find("held out (3 cases: '");
  ASSERT_NE(held, std::string::npos) << result.out;
  const std::string line = result.out.substr(held, result.out.find('\n', held) - held);
  expect_words(line, {"default ", " % (breaks the constraint: acne ", ") → "});
}

TEST_F(Tune, Over_several_lights_and_parameters_beats_the_default_and_repeats_to_the_bit) {
  const std::vector<std::string> flags = {"--vary",        "shadow.constant-bias=0:8texels",
                                          "--vary",        "shadow.slope-bias=0:4",
                                          "--vary",        "shadow.normal-offset=0:2",
                                          "--constraint",  "acne<5%",
                                          "--evaluations", "15"};
  const Json first = tuning("first", flags);
  EXPECT_LT(first["best"]["cost"].get<double>(), first["default"]["cost"].get<double>());
  EXPECT_TRUE(first["best"]["keeps_constraints"]);
  EXPECT_EQ(first["sensitivity"].size(), 3u);
  EXPECT_EQ(first["evaluations"], 15);
  EXPECT_EQ(tuning("second", flags), first);
  EXPECT_EQ(text_of(folder_ / "second/evaluations.csv"), text_of(folder_ / "first/evaluations.csv"));
}

// As in compare: spot and point lights do not read it. Without a sun nothing does.
TEST_F(Tune, Cascades_of_the_sun_may_be_tuned_beside_other_lights) {
  const std::vector<std::string> flags = {"--shadow.cascades", "3", "--vary", "shadow.constant-bias=0:4texels",
                                          "--evaluations",     "5"};
  EXPECT_EQ(tuning("all", flags)["best"]["cases"].size(), 4u);
  const ProgramResult lamp = run_program(arguments("lamp", words(flags, {"--light", "lamp"})));
  EXPECT_EQ(lamp.exit_code, 2);
  EXPECT_NE(lamp.err.find("no measured light is directional"), std::string::npos) << lamp.err;
}

TEST_F(Tune, Interrupted_run_resumes_to_the_same_result) {
  const std::vector<std::string> flags = {
      "--light", "sun", "--vary", "shadow.slope-bias=0:4", "--vary", "shadow.normal-offset=0:2", "--evaluations", "20"};
  const Json whole = tuning("whole", flags);
  ProgramOptions options;
  options.signal = SIGINT;
  options.signal_counts_from = [&] {
    const std::filesystem::path path = folder_ / "parts/tuning.partial.jsonl";
    if (!std::filesystem::exists(path)) return false;
    const std::string journal = text_of(path);
    return std::count(journal.begin(), journal.end(), '\n') > 5;
  };
  const ProgramResult interrupted = run_program(arguments("parts", flags), options);
  EXPECT_EQ(interrupted.exit_code, 130) << interrupted.err;
  EXPECT_NE(interrupted.err.find("rerun the command to resume"), std::string::npos) << interrupted.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "parts/summary.json"));
  EXPECT_EQ(tuning("parts", flags), whole);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "parts/tuning.partial.jsonl"));
}

TEST_F(Tune, Of_ambient_occlusion_goes_through_all_combinations_where_these_are_few) {
  const Json tuned =
      tuning("ao", {"--vary", "ao.samples=4,16", "--vary", "ao.blur-size=2,4,8", "--constraint", "ao.samples<=8"});
  EXPECT_EQ(tuned["method"], "all 6 combinations");
  EXPECT_EQ(tuned["best"]["values"]["ao.samples"], 4);
  // 16 rays leave noise, which can only have raised the cost.
  const double cost = tuned["best"]["cost"];
  const Json& interval = tuned["best"]["cost_95"];
  EXPECT_GT(cost - interval["lo"].get<double>(), 1.1 * (interval["hi"].get<double>() - cost));
}

TEST_F(Tune, Search_starts_at_the_default_although_its_unit_depends_on_the_scene) {
  const Json tuned = tuning("start", {"--vary", "ao.radius=0.5%:8%:log", "--vary", "ao.power=0.5:4:log", "--minimize",
                                      "rmse", "--evaluations", "1"});
  EXPECT_EQ(tuned["default"]["values"]["ao.radius"], 2.0);
  // One evaluation: the default; all others are of the scans, which find a better point.
  const std::string rows = text_of(folder_ / "start/evaluations.csv");
  EXPECT_NE(rows.find("\n1,2,1," + Json(tuned["default"]["cost"]).dump() + ","), std::string::npos) << rows;
  EXPECT_LT(tuned["best"]["cost"], tuned["default"]["cost"]);
}

// A texel is 2.5 pixels, and the reference is antialiased: a staircase costs roughness, a blurred edge mean error.
TEST_F(Tune, Of_the_filter_chooses_nearest_by_mean_error_and_a_blur_by_roughness) {
  const auto tuned = [&](const std::string& output, const std::vector<std::string>& more) {
    const ProgramResult result = run_program(
        words({"tune", "contact-box", "-o", folder_ / output, "--light", "sun", "--size", "240x135", "--no-figures",
               "--truth.shadow", "pixel", "--truth.spp", "16", "--shadow.resolution", "64", "--vary",
               "shadow.filter=nearest,bilinear", "--vary", "shadow.constant-bias=1texels:2texels:3"},
              more));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return Json::parse(text_of(folder_ / (output + "/summary.json")))["tuning"];
  };
  const Json by_error = tuned("mae", {"--minimize", "mae"});
  EXPECT_EQ(by_error["best"]["values"]["shadow.filter"], "nearest");
  const Json by_roughness = tuned("roughness", {"--minimize", "edge-roughness", "--constraint", "|edge-displacement|<1",
                                                "--run.metrics", "mae,edge-width"});
  EXPECT_EQ(by_roughness["best"]["values"]["shadow.filter"], "bilinear");
  EXPECT_TRUE(by_roughness["best"]["keeps_constraints"]);

  // The table says why: bilinear is smoother, wider, and farther off in the mean.
  const Json& rows = by_roughness["compared"];
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0]["name"], "default");
  EXPECT_EQ(rows[1]["name"], "filter nearest");
  EXPECT_GT(rows[1]["minus_best"]["value"], 0.0);
  EXPECT_EQ(rows[2]["minus_best"], nullptr);
  EXPECT_GT(rows[2]["statistics"]["edge-width"], rows[1]["statistics"]["edge-width"]);
  EXPECT_GT(rows[2]["statistics"]["mae"], rows[1]["statistics"]["mae"]);
}

TEST_F(Tune, Refuses_in_one_line_what_it_cannot_tune) {
  const auto expect = [&](const std::vector<std::string>& more, const std::string& part) {
    const ProgramResult result = run_program(arguments("refused", more));
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "refused"));
  };
  const std::vector<std::string> bias = {"--vary", "shadow.constant-bias=0:8texels"};
  expect({}, "nothing to vary");
  expect({"--vary", "view.camera=0,1"}, "use --over");
  expect({"--vary", "shadow.constant-bias=8texels:0texels"}, "the first end is larger");
  expect(words(bias, {"--minimize", "flup"}), "there is no statistic 'flup'");
  expect(words(bias, {"--constraint", "acne"}), "there is no <");
  expect(words(bias, {"--over", "view.camera"}), "no '='");
  expect(words(bias, {"--over", "shadow.constant-bias=1"}), "is varied, too");
  expect(words(bias, {"--light", "sun", "--camera", "0", "--held-out", "view.camera=overview"}),
         "the search uses this case, too: ");
  expect(words(bias, {"--vary", "ao.radius=0.1:1"}), "both shadows and ambient occlusion");
  expect({"--light", "sun", "--vary", "shadow.esm-exponent=1:80"}, "shadow.technique pcf does not read it");
  expect({"--vary", "ao.gtao-falloff=0.1:0.9"}, "ao.technique ssao does not read it");
  expect(words(bias, {"--shadow.technique", "vsm", "--light", "sun", "--minimize", "acne"}), "report no 'acne'");
}

// The rule of compare and sweep: where a large bias costs nothing that the view shows, no bias is recommended.
TEST_F(Tune, Where_no_bias_can_be_known_it_says_why) {
  const auto answer = [&](const std::string& scene, const std::string& light, const std::string& size) {
    return run_program({"tune", scene, "-o", folder_ / "unknown", "--force", "--light", light, "--size", size,
                        "--no-figures", "--for", "godot", "--vary", "shadow.constant-bias=0texels:8texels"})
        .out;
  };
  const std::string unshadowed = answer("tilted-plane", "sun-60", "96x54");
  EXPECT_EQ(unshadowed.find("no bias recommended: no counted pixel is in shadow"), 0u) << unshadowed;
  EXPECT_EQ(unshadowed.find("Godot"), std::string::npos) << unshadowed;
  const std::string reason = "no counted pixel is in shadow, so a large bias costs nothing; choose a view with shadows";
  const Json recommended = Json::parse(text_of(folder_ / "unknown/summary.json"))["tuning"]["recommended_bias"];
  EXPECT_TRUE(recommended["recommended"].is_null());
  EXPECT_EQ(recommended["withheld"], reason);
  EXPECT_NE(text_of(folder_ / "unknown/tuned.toml").find("; no bias recommended: " + reason + ".\n"),
            std::string::npos);
  // The file keeps the given bias.
  EXPECT_NE(text_of(folder_ / "unknown/tuned.toml").find("\nconstant-bias = \"1.5texels\""), std::string::npos);
  const std::string few = answer("contact-box", "sun", "9x5");
  EXPECT_EQ(few.find("no bias recommended: only 26 counted pixels"), 0u) << few;
}

TEST_F(Tune, Fewer_evaluations_than_words_are_refused) {
  const ProgramResult refused =
      run_program(arguments("few", {"--light", "sun", "--vary", "shadow.filter=box,tent", "--evaluations", "1"}));
  EXPECT_EQ(refused.exit_code, 2) << refused.err;
  EXPECT_NE(refused.err.find("--evaluations: 1 is fewer than the 2 combinations"), std::string::npos) << refused.err;
}

// What sweep and compare say of the same axes.
TEST_F(Tune, Says_what_its_cost_does_not_show) {
  const ProgramResult filters =
      run_program(arguments("filters", {"--light", "sun", "--vary", "shadow.filter=nearest,box"}));
  EXPECT_NE(filters.out.find("warning: against a hard shadow every blurred pixel is wrong"), std::string::npos);
  EXPECT_NE(filters.out.find("warning: each filter needs its own bias"), std::string::npos) << filters.out;
  const ProgramResult soft =
      run_program(arguments("soft", {"--light", "sun", "--light.angle", "2", "--vary", "shadow.filter=nearest,box",
                                     "--vary", "shadow.constant-bias=0.01:0.1", "--evaluations", "6"}));
  EXPECT_NE(soft.out.find("shadow.filter: with at most 6 evaluations, 60 by default, "), std::string::npos) << soft.out;
  EXPECT_EQ(soft.out.find("every blurred pixel is wrong"), std::string::npos) << soft.out;
  const ProgramResult ao = run_program(arguments("ao", {"--vary", "ao.radius=0.1,0.2", "--truth.ao-distance", "0.25"}));
  EXPECT_NE(ao.err.find("the reference is the same at every point: rays up to 25 cm"), std::string::npos) << ao.err;
}

TEST_F(Tune, Says_which_constraint_no_point_keeps) {
  const ProgramResult result = run_program(
      arguments("strict", {"--light", "sun", "--vary", "shadow.constant-bias=0:8texels", "--constraint", "lit>99%"}));
  EXPECT_NE(result.out.find("by the sum of all relative excesses: lit "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(" % in corner, camera overview, sun"), std::string::npos) << result.out;
}

TEST_F(Tune, Names_the_bias_that_compare_recommends_where_the_best_point_is_another) {
  const auto answer = [&](const std::vector<std::string>& command) {
    return run_program(words(command, {"-o", folder_ / command.front(), "--size", "160x90", "--light", "lantern",
                                       "--no-figures"}))
        .out;
  };
  const std::string compared = answer({"compare", "courtyard", "--measure", "shadows"});
  const std::string start = "lantern: use bias ";
  ASSERT_EQ(compared.find(start), 0u) << compared;
  const std::string bias = compared.substr(start.size(), compared.find(" (") - start.size());
  EXPECT_TRUE(bias.ends_with(" texels")) << bias;
  EXPECT_NE(compared.find(" have at most 3 wrong pixels more than the least error ("), std::string::npos) << compared;
  EXPECT_NE(text_of(folder_ / "compare/index.html").find("with at most 3 wrong pixels more than the least error"),
            std::string::npos);
  const std::string tuned = answer({"tune", "courtyard", "--vary", "shadow.constant-bias=0texels:8texels"});
  EXPECT_EQ(tuned.find("use constant-bias " + bias + ": mean absolute error 0."), 0u) << tuned;
  EXPECT_NE(tuned.find("/tuned.toml with constant-bias " + bias + "; "), std::string::npos) << tuned;
  const Json tuning = Json::parse(text_of(folder_ / "tune/summary.json"))["tuning"];
  const Json recommended = tuning["recommended_bias"]["recommended"];
  EXPECT_EQ(tuning["recommended"]["cost"], recommended["cost"]);
  EXPECT_EQ(tuning["recommended"]["values"]["shadow.constant-bias"], recommended["constant_bias"]);
  // The held-out check is of the point to use.
  const Json held = tuning["held_out"];
  EXPECT_EQ(held["recommended"]["values"], tuning["recommended"]["values"]);
  EXPECT_NE(held["recommended"]["cost"], held["best"]["cost"]);
  EXPECT_NE(tuned.find("; the recommended point is "), std::string::npos) << tuned;
  ASSERT_EQ(
      run_program({"compare", "-c", folder_ / "tune/tuned.toml", "-o", folder_ / "use", "--no-figures"}).exit_code, 0);
  const Json used = Json::parse(text_of(folder_ / "use/summary.json"))["shadows"][0]["statistics"];
  EXPECT_NEAR(used["mae"].get<double>(), recommended["cost"].get<double>(), 1e-12);
  ASSERT_EQ(run_program({"tune", "courtyard", "--vary", "shadow.constant-bias=0texels:8texels", "-o", folder_ / "page",
                         "--size", "160x90", "--light", "lantern"})
                .exit_code,
            0);
  for (const char* point : {"recommended", "best", "default"}) {
    const std::string file = std::string("page/figures/") + point + "_error_visibility_lantern.svg";
    EXPECT_TRUE(std::filesystem::exists(folder_ / file)) << file;
  }
  EXPECT_NE(text_of(folder_ / "page/index.html").find("Recommended, best and default point"), std::string::npos);
}

}  // namespace
}  // namespace umbrameter
