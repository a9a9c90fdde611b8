// `check` on summaries that are written here: what it exits with, prints and writes, and how it refuses.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/run_program.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

/// A run of one light, whose reference is exact, and of AO.
std::string summary(double acne, double psnr = 30.0) {
  const Json shadow = {
      {"light", "sun"},
      {"index", 0},
      {"statistics", {{"pixels", 10000}, {"mae", 0.02}, {"acne", acne}, {"mean_error", -0.01}, {"max_error", 1.0}}},
      {"metrics", {{"psnr", psnr}}}};
  const Json ao = {{"statistics", {{"pixels", 5000}, {"mae", 0.1}, {"mae_lo", 0.06}, {"mae_hi", 0.11}}}};
  return Json({{"scene", {{"name", "court"}}}, {"shadows", {shadow}}, {"ao", ao}}).dump();
}

class Check : public testing::Test {
 protected:
  std::string run(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(folder_ / name);
    folder_.write(name + "/summary.json", text);
    return folder_ / name;
  }
  std::string budget(const std::string& text) const { return folder_.write("budget.toml", text); }

  TemporaryFolder folder_;
};

constexpr const char* acne_budget = "[[budget]]\nscene = \"court\"\nstatistic = \"acne\"\nbound = \"< 1.2%\"\n";

TEST_F(Check, Passes_within_the_bounds_and_fails_beyond_them) {
  const std::string good = run("good", summary(0.01)), bad = run("bad", summary(0.02));
  const ProgramResult passed = run_program({"check", good, "--budget", budget(acne_budget)});
  EXPECT_EQ(passed.exit_code, 0) << passed.err;
  EXPECT_EQ(passed.out, "the bound is kept: acne 1.000 %, < 1.200 %\n");

  const ProgramResult failed = run_program({"check", bad, "--budget", budget(acne_budget), "--json"});
  EXPECT_EQ(failed.exit_code, 1) << failed.err;
  const Json check = Json::parse(failed.out)["checks"][0];
  EXPECT_FALSE(check["kept"]);
  EXPECT_EQ(check["run"], "bad");
  EXPECT_NEAR(check["excess"], 0.008, 1e-12);
}

TEST_F(Check, Of_several_runs_each_bound_names_the_folder) {
  const ProgramResult result =
      run_program({"check", run("good", summary(0.01)), run("bad", summary(0.02)), "--budget", budget(acne_budget)});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.out.find("bad: court, sun"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("1 of 2 checks in 2 runs is broken"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("good: court, sun"), std::string::npos) << "it keeps its bound";
}

TEST_F(Check, Only_the_rays_of_a_sampled_reference_give_an_interval) {
  const ProgramResult result = run_program(
      {"check", run("good", summary(0.01)), "--budget",
       budget("[[budget]]\nstatistic = \"acne\"\nbound = 0\n[[budget]]\nstatistic = \"ao.mae\"\nbound = 0.07\n"),
       "--json"});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  const Json checks = Json::parse(result.out)["checks"];
  EXPECT_EQ(checks[0]["half_width_95"], 0.0);
  EXPECT_TRUE(checks[0]["excess_in_intervals"].is_null());
  EXPECT_NEAR(checks[1]["half_width_95"], 0.01, 1e-12);
  // The bound lies below: (0.1 − 0.07) / (0.1 − 0.06). Noise of the rays can explain all of it.
  EXPECT_NEAR(checks[1]["excess_in_intervals"], 0.75, 1e-9);

  const auto last_cell = [&](const std::string& bound) {
    const std::string out =
        run_program({"check", folder_ / "good", "--budget", budget("[[budget]]\nstatistic = " + bound)}).out;
    return out.substr(out.rfind("  ", out.rfind('\n', out.size() - 2)) + 2);
  };
  EXPECT_TRUE(last_cell("\"acne\"\nbound = 0\n").starts_with("—"));
  EXPECT_TRUE(last_cell("\"ao.mae\"\nbound = 0.07\n").starts_with("yes"));
  EXPECT_TRUE(last_cell("\"ao.mae\"\nbound = 0.02\n").starts_with("no, at most 4.0 percentage points of it"));
}

// Alone, the second run fails as not measured.
TEST_F(Check, Of_several_runs_those_without_a_bounded_statistic_are_named) {
  Json without = Json::parse(summary(0.01));
  without["shadows"][0]["statistics"].erase("acne");
  const std::string good = run("good", summary(0.01)), other = run("other", without.dump());
  const std::string bounds = budget(acne_budget);
  const ProgramResult both = run_program({"check", good, other, "--budget", bounds});
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_NE(both.err.find("other (court, sun) has not measured acne: no bound on acne was checked there"),
            std::string::npos)
      << both.err;
  EXPECT_EQ(both.err.find("good ("), std::string::npos) << both.err;
  EXPECT_EQ(run_program({"check", other, "--budget", bounds}).exit_code, 1);
}

TEST_F(Check, Writes_junit_and_appends_to_the_step_summary) {
  const std::string bad = run("bad", summary(0.02));
  const std::string junit = folder_ / "junit.xml";
  const std::string page = folder_.write("page.md", "before\n");
  EXPECT_EQ(run_program({"check", bad, "--budget", budget(acne_budget), "--junit", junit, "--summary", page}).exit_code,
            1);
  EXPECT_NE(text_of(junit).find("<testsuite name=\"umbrameter\" tests=\"1\" failures=\"1\""), std::string::npos);
  EXPECT_NE(text_of(junit).find("<testcase classname=\"court, sun\" name=\"acne &lt; 1.200 %\""), std::string::npos)
      << text_of(junit);
  EXPECT_EQ(text_of(page).rfind("before\n### ❌ Umbrameter: the bound is broken\n", 0), 0u) << text_of(page);
}

TEST_F(Check, Update_writes_bounds_that_the_run_keeps_with_head_room_and_that_a_worse_run_breaks) {
  const std::string good = run("good", summary(0.001)), bad = run("bad", summary(0.02, 20.0));
  const std::string file = folder_ / "new.toml";
  EXPECT_EQ(run_program({"check", good, "--budget", file, "--update"}).exit_code, 0);
  const auto expect_bound = [&](const std::string& bound) {
    EXPECT_NE(text_of(file).find("bound = \"" + bound + "\""), std::string::npos) << text_of(file);
  };
  expect_bound("<= 0.11%");  // acne: ten of 10,000 pixels and one more
  expect_bound("<= 2.02%");  // mae: 2 % and 1 % of it
  expect_bound("<= 11%");    // ao.mae: 10 % and what is up to the upper bound
  expect_bound(">= 29.7");   // 30 dB less 1 %
  EXPECT_EQ(run_program({"check", good, "--budget", file}).exit_code, 0);
  const ProgramResult worse = run_program({"check", bad, "--budget", file});
  EXPECT_EQ(worse.exit_code, 1);
  EXPECT_NE(worse.out.find("2 of 4 bounds are broken"), std::string::npos) << worse.out;
  // Updating changes the values alone.
  EXPECT_EQ(run_program({"check", bad, "--budget", file, "--update"}).exit_code, 0);
  EXPECT_EQ(run_program({"check", bad, "--budget", file}).exit_code, 0);
}

TEST_F(Check, Update_counts_what_it_adds_apart_from_what_it_changes) {
  const std::string file = budget("[[budget]]\nscene = \"other\"\nstatistic = \"acne\"\nbound = 0.5\n");
  const ProgramResult result =
      run_program({"check", run("good", summary(0.001)), "--budget", file, "--update", "--quiet"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("0 of 1 bounds updated, 4 added"), std::string::npos) << result.out;
}

TEST_F(Check, Update_bounds_a_signed_error_on_both_sides_of_0) {
  const auto run_with = [&](const std::string& name, double mean_error) {
    Json json = Json::parse(summary(0.001));
    json["ao"]["statistics"]["mean_error"] = mean_error;
    return run(name, json.dump());
  };
  const std::string bright = run_with("bright", 0.08), dark = run_with("dark", -0.2);
  const std::string file = folder_ / "signed.toml";
  EXPECT_EQ(run_program({"check", bright, "--budget", file, "--update"}).exit_code, 0);
  EXPECT_NE(text_of(file).find("\"|mean_error|\""), std::string::npos) << text_of(file);
  EXPECT_NE(text_of(file).find("\"psnr\""), std::string::npos) << "a score has one good side";
  EXPECT_EQ(run_program({"check", dark, "--budget", file}).exit_code, 1);
}

TEST_F(Check, Budget_that_names_nothing_in_the_run_fails) {
  const ProgramResult result =
      run_program({"check", run("good", summary(0.01)), "--budget",
                   budget("[[budget]]\nscene = \"other\"\nstatistic = \"acne\"\nbound = 0.5\n")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.out.find("not measured"), std::string::npos) << result.out;
}

TEST_F(Check, Bounds_of_a_scene_that_no_run_shows_are_one_row) {
  const std::string other = "[[budget]]\nscene = \"other\"\nstatistic = \"";
  const std::string two = other + "acne\"\nbound = 0.5\n" + other + "leak\"\nbound = 0.5\n";
  const ProgramResult result = run_program({"check", run("good", summary(0.01)), "--budget", budget(two)});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.out.find("all 2 bounds"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("acne"), std::string::npos) << result.out;
}

// A run that a budget forgot would pass for ever.
TEST_F(Check, Names_a_run_of_which_nothing_is_bounded_and_update_bounds_it) {
  Json forgotten = Json::parse(summary(0.3));
  forgotten["scene"]["name"] = "forgotten";
  const std::string good = run("good", summary(0.01)), other = run("other", forgotten.dump());
  const std::string file = budget(acne_budget);
  const ProgramResult checked = run_program({"check", good, other, "--budget", file});
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_NE(checked.err.find("no bound names other (forgotten): nothing of it was checked"), std::string::npos)
      << checked.err;
  EXPECT_EQ(checked.err.find("names good"), std::string::npos) << checked.err;
  const Json json = Json::parse(run_program({"check", good, other, "--budget", file, "--json"}).out);
  EXPECT_EQ(json["notes"].size(), 1u);
  const ProgramResult updated = run_program({"check", good, other, "--budget", file, "--update"});
  EXPECT_EQ(updated.err.find("no bound names"), std::string::npos) << updated.err;
  EXPECT_NE(text_of(file).find("\"forgotten\""), std::string::npos) << text_of(file);
  EXPECT_EQ(run_program({"check", good, other, "--budget", file}).err, "");
}

TEST_F(Check, Two_runs_of_a_scene_have_each_bound_once) {
  const std::string file = folder_ / "once.toml";
  run_program({"check", run("good", summary(0.01)), run("again", summary(0.02)), "--budget", file, "--update"});
  const std::string text = text_of(file);
  EXPECT_EQ(text.find("\"acne\""), text.rfind("\"acne\"")) << text;
}

// The summary of a sweep holds the cell of least error, which is that of the easiest view.
TEST_F(Check, Says_that_of_a_sweep_over_views_one_alone_is_checked) {
  Json swept = Json::parse(summary(0.01));
  swept["cell"] = {{"view.camera", "arcade"}, {"shadow.constant-bias", 2.0}, {"view.light", "sun"}};
  const ProgramResult result = run_program({"check", run("views", swept.dump()), "--budget", budget(acne_budget)});
  EXPECT_NE(result.err.find("views is a sweep over views, of which only that of least error is checked (view.camera "
                            "arcade, view.light sun)"),
            std::string::npos)
      << result.err;
}

TEST_F(Check, Says_what_to_run_in_place_of_a_tuning) {
  const ProgramResult result =
      run_program({"check", run("tuned", Json({{"scene", {{"name", "court"}}}, {"tuning", Json::object()}}).dump()),
                   "--budget", budget(acne_budget)});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("is of a tuning"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("for each scene and camera: umbrameter compare -c tuned.toml"), std::string::npos)
      << result.err;
}

TEST_F(Check, Kind_light_and_magnitude_select_the_value) {
  const std::string good = run("good", summary(0.01));
  const auto exit_code = [&](const std::string& lines) {
    return run_program({"check", good, "--budget", budget("[[budget]]\n" + lines)}).exit_code;
  };
  EXPECT_EQ(exit_code("statistic = \"mae\"\nbound = \"5%\""), 1);  // AO has 10 %
  EXPECT_EQ(exit_code("statistic = \"mae\"\nbound = \"5%\"\nkind = \"shadow\""), 0);
  EXPECT_EQ(exit_code("statistic = \"shadow.mae\"\nbound = \"5%\""), 0);
  EXPECT_EQ(exit_code("statistic = \"mae\"\nbound = \"5%\"\nlight = \"SUN\""), 0);
  EXPECT_EQ(exit_code("statistic = \"mae\"\nbound = \"5%\"\nlight = 0"), 0);
  EXPECT_EQ(exit_code("statistic = \"mean_error\"\nbound = 0"), 0);
  EXPECT_EQ(exit_code("statistic = \"|mean_error|\"\nbound = 0"), 1);
}

TEST_F(Check, Hostile_budgets_are_refused_in_one_line_with_their_place) {
  const std::string good = run("good", summary(0.01));
  const auto expect = [&](const std::string& text, int exit_code, const std::string& part) {
    const ProgramResult result = run_program({"check", good, "--budget", budget(text)});
    EXPECT_EQ(result.exit_code, exit_code) << text << result.err;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
  };
  expect("not = toml = at all", 2, "budget.toml:1:");
  expect("", 2, "it holds no [[budget]]");
  std::string deep = "[a";
  for (int i = 0; i < 40'000; ++i) deep += ".a";
  expect(deep + "]\n", 2, "levels deep");
  expect("budget = 3", 2, "budget.toml:1: 'budget' must be a list of tables");
  expect("budget = [3]", 2, "'budget' must be a list of tables");
  expect("[budgets]\na = 1", 2, "unknown key 'budgets'");
  expect("[[budget]]\nstatistic = \"acne\"", 2, "budget.toml:1: a budget needs 'bound'");
  expect("[[budget]]\nbound = 1", 2, "a budget needs 'statistic'");
  expect("[[budget]]\nstatistic = 3\nbound = 1", 2, "budget.toml:2: 'statistic' must be a string");
  expect("[[budget]]\nstatistic = \"acne\"\nbound = nan", 2, "budget.toml:3: the bound must be a finite number");
  expect("[[budget]]\nstatistic = \"acne\"\nbound = true", 2, "'bound' must be a number or a string");
  expect("[[budget]]\nstatistic = \"acne\"\nbound = \"low\"", 2, "there is no number");
  expect("[[budget]]\nstatistic = \"acne\"\nbound = \"< 3 dB\"", 2, "acne is a share");
  expect("[[budget]]\nstatistic = \"acme\"\nbound = 1", 2, "did you mean 'acne'");
  expect("[[budget]]\nstatistic = \"acne\"\nbound = 1\nlihgt = \"sun\"", 2, "did you mean 'light'");
  expect("[[budget]]\nstatistic = \"acne\"\nbound = 1\nkind = \"sound\"", 2, "choose shadow, ao or image");
}

TEST_F(Check, Refuses_folders_and_files_that_it_cannot_read) {
  const std::string good = run("good", summary(0.01));
  const auto expect = [&](const std::vector<std::string>& words, int exit_code, const std::string& part) {
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
  };
  expect({"check", folder_ / "none", "--budget", budget(acne_budget)}, 4, "none/summary.json");
  expect({"check", run("text", "hello"), "--budget", budget(acne_budget)}, 4, "is no summary");
  expect({"check", run("other", R"({"scene": {"name": 3}})"), "--budget", budget(acne_budget)}, 4, "is damaged");
  expect({"check", run("empty", R"({"scene": {"name": "a"}})"), "--budget", budget(acne_budget)}, 4, "no statistics");
  const std::string newer = R"({"schema_version": 3, "scene": {"name": "a"}})";
  expect({"check", run("newer", newer), "--budget", budget(acne_budget)}, 4,
         "schema version 3, this program reads up to 2");
  expect({"check", good, "--budget", folder_ / "missing.toml"}, 4,
         "missing.toml: there is no such file; write it with --update");
  expect({"check", good}, 2, "--budget");
  expect({"check", good, "--budget", budget(acne_budget), "--update", "--junit", "x.xml"}, 2, "--update");
}

}  // namespace
}  // namespace umbrameter
