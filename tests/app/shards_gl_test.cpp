// plan, run, merge and status as programs: the files of the undivided sweep, and what is refused.
#include <nlohmann/json.hpp>

#include "reports/files/output.h"
#include "tests/app/gl_run.h"
#include "tests/app/same_files.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

struct Shards : GlRun {
  std::vector<std::string> sweep(const std::string& scene) const {
    return {"sweep",   scene,
            "--size",  "64x36",
            "--light", "0",
            "--vary",  "shadow.constant-bias=0:0.1:4",
            "--vary",  "shadow.resolution=64,128,256",
            "--vary",  "shadow.filter=nearest,box"};
  }
  ProgramResult plan(const std::string& scene, const std::vector<std::string>& more) const {
    return run_program(words({"plan"}, words(words(sweep(scene), {"-o", plan_.string()}), more)));
  }
  ProgramResult run(const std::string& shards, const ProgramOptions& options = {}) const {
    return run_program({"run", plan_.string(), "--shard", shards}, options);
  }
  ProgramResult merge(const std::vector<std::string>& more = {}) const {
    return run_program(words({"merge", plan_.string(), "-o", merged_.string()}, more));
  }
  fs::path plan_ = folder_ / "plan";
  fs::path merged_ = folder_ / "merged";
};

TEST_F(Shards, A_merged_sweep_has_all_files_of_the_undivided_one_to_the_byte) {
  const fs::path undivided = folder_ / "undivided";
  ASSERT_EQ(run_program(words(sweep("corner"), {"-o", undivided.string()})).exit_code, 0);
  const ProgramResult planned = plan("corner", {"--shards", "3"});
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  EXPECT_NE(planned.out.find("24 cells in 3 shards"), std::string::npos) << planned.out;
  for (const char* shard : {"2", "0", "1"}) ASSERT_EQ(run(shard).exit_code, 0);
  const ProgramResult merged = merge();
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  expect_same_files(merged_, undivided);
}

// Each has one group of cells, which share a map and a reference.
TEST_F(Shards, Cells_that_share_a_map_are_cut_and_merge_to_the_files_of_the_undivided_sweep) {
  const std::vector<std::string> corner = {"corner", "--size", "64x36"};
  const std::vector<std::vector<std::string>> sweeps = {
      {"--light", "0", "--vary", "shadow.constant-bias=0:0.1:7", "--vary", "shadow.slope-bias=0,1,2"},
      {"--light", "0", "--light.angle", "2", "--truth.spp", "4", "--vary", "shadow.constant-bias=0:0.1:7"},
      {"--vary", "ao.samples=4,8,16", "--vary", "ao.power=1,2,3", "--truth.spp", "4"}};
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const fs::path undivided = folder_ / ("undivided" + std::to_string(i));
    plan_ = folder_ / ("plan" + std::to_string(i));
    merged_ = folder_ / ("merged" + std::to_string(i));
    const std::vector<std::string> sweep = words(corner, sweeps[i]);
    ASSERT_EQ(run_program(words(words({"sweep"}, sweep), {"-o", undivided.string()})).exit_code, 0);
    const ProgramResult planned =
        run_program(words(words({"plan", "sweep"}, sweep), {"-o", plan_.string(), "--shards", "5"}));
    ASSERT_EQ(planned.exit_code, 0) << planned.err;
    EXPECT_NE(planned.out.find("in 5 shards"), std::string::npos) << planned.out;
    EXPECT_NE(planned.out.find("what they repeat adds"), std::string::npos) << planned.out;
    ASSERT_EQ(run("0-4").exit_code, 0);
    ASSERT_EQ(merge().exit_code, 0);
    expect_same_files(merged_, undivided);
  }
}

TEST_F(Shards, A_page_shows_the_progress_and_what_failed_with_the_command_to_run_it_again) {
  ASSERT_EQ(plan("corner", {"--shards", "4"}).exit_code, 0);
  ASSERT_EQ(run("0").exit_code, 0);
  write_text(plan_ / "shards/2.failed", "no memory <left>\n");
  write_text(plan_ / "shards/3.running", R"({"host": "node3", "process": 1, "share": 0.5})");
  const fs::path page = folder_ / "status.html";
  ASSERT_EQ(run_program({"status", plan_.string(), "-o", page.string()}).exit_code, 0);
  const std::string html = text_of(page);
  for (const char* text : {"1 of 4 shards done", "no memory &lt;left&gt;", "node3", "--shard 2</code>"}) {
    EXPECT_NE(html.find(text), std::string::npos) << text;
  }
}

TEST_F(Shards, A_plan_holds_its_scene_file_and_no_absolute_path) {
  const fs::path scene = folder_ / "my scene.glb";
  ASSERT_EQ(run_program({"scene", "corner", "-o", scene.string()}).exit_code, 0);
  ASSERT_EQ(plan(scene.string(), {"--cells-per-shard", "8"}).exit_code, 0);
  fs::remove(scene);
  const fs::path moved = folder_ / "moved";
  fs::rename(plan_, moved);
  plan_ = moved;
  for (const char* name : {"plan.json", "experiment.toml"}) {
    EXPECT_EQ(text_of(plan_ / name).find(folder_.path().string()), std::string::npos) << name;
  }
  ASSERT_EQ(run("0-2").exit_code, 0);
  ASSERT_EQ(merge({"--no-figures"}).exit_code, 0);
  const fs::path undivided = folder_ / "undivided";
  ASSERT_EQ(
      run_program(words(sweep((plan_ / "scene" / "my scene.glb").string()), {"-o", undivided.string(), "--no-figures"}))
          .exit_code,
      0);
  EXPECT_TRUE(text_of(merged_ / "results.sqlite") == text_of(undivided / "results.sqlite"));
}

TEST_F(Shards, Another_scene_at_the_path_of_a_plan_by_reference_is_refused) {
  const fs::path scene = folder_ / "scene.glb";
  ASSERT_EQ(run_program({"scene", "corner", "-o", scene.string()}).exit_code, 0);
  ASSERT_EQ(plan(scene.string(), {"--shards", "2", "--by-reference"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(plan_ / "scene"));
  ASSERT_EQ(run("0").exit_code, 0);
  ASSERT_EQ(run_program({"scene", "ramp", "-o", scene.string()}).exit_code, 0);
  const ProgramResult other = run("1");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("content of the scene"), std::string::npos) << other.err;
  const auto status = nlohmann::json::parse(run_program({"status", plan_.string(), "--json"}).out);
  EXPECT_EQ(status["done"], nlohmann::json({0}));
  EXPECT_EQ(status["failed"], nlohmann::json({1})) << "and says why in the terminal";
}

TEST_F(Shards, A_merge_without_all_shards_says_what_to_run_again_and_writes_the_rest_on_demand) {
  ASSERT_EQ(plan("corner", {"--shards", "6"}).exit_code, 0);
  ProgramOptions task;
  task.environment = {"SLURM_ARRAY_TASK_ID=1"};
  ASSERT_EQ(run("env", task).exit_code, 0);
  ASSERT_EQ(run("0,5").exit_code, 0);
  const ProgramResult again = run("5");
  EXPECT_NE(again.out.find("done already"), std::string::npos) << again.out;
  fs::resize_file(plan_ / "shards/5.shard", 100);

  const ProgramResult missing = merge();
  EXPECT_EQ(missing.exit_code, 5);
  EXPECT_NE(missing.out.find("--array=2-5"), std::string::npos) << missing.out;
  EXPECT_NE(missing.out.find("numbers:  2 3 4 5"), std::string::npos) << missing.out;
  EXPECT_NE(missing.err.find("4 of 6 shards are missing or broken"), std::string::npos) << missing.err;
  EXPECT_NE(missing.err.find("5.shard"), std::string::npos) << missing.err;
  EXPECT_FALSE(fs::exists(merged_)) << "nothing is written";

  EXPECT_EQ(merge({"--partial"}).exit_code, 5);
  const std::string rows = text_of(merged_ / "sweep.partial.csv");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1 + 8) << "a line of names and two shards of four cells";
  EXPECT_FALSE(fs::exists(merged_ / "sweep.csv"));
  const std::string page = text_of(merged_ / "index.html");
  EXPECT_NE(page.find("Partial result: 8 of 24 cells"), std::string::npos);
  EXPECT_NE(page.find("shard 3, 4 cells: from shadow."), std::string::npos);
  for (const auto& entry : fs::recursive_directory_iterator(merged_)) {
    EXPECT_NE(entry.path().extension(), ".sqlite") << "no store that looks whole";
  }

  const std::string commands = run_program({"status", plan_.string(), "--commands"}).out;
  EXPECT_NE(commands.find("umbrameter run " + plan_.string() + " --shard 2\n"), std::string::npos) << commands;
  ASSERT_EQ(run("2-5").exit_code, 0) << "a broken result is measured again";
  EXPECT_EQ(merge({"--no-figures"}).exit_code, 0) << "the partial result gives way";
  EXPECT_FALSE(fs::exists(merged_ / "sweep.partial.csv"));
  EXPECT_EQ(text_of(merged_ / "index.html").find("Partial result"), std::string::npos);
}

TEST_F(Shards, What_is_missing_shows_without_a_device_and_beyond_the_default_array_of_Slurm_without_its_option) {
  ASSERT_EQ(plan("corner", {"--shards", "2"}).exit_code, 0);
  ProgramOptions without;
  without.environment = {"EGL_PLATFORM=nothing", "__EGL_VENDOR_LIBRARY_FILENAMES=/nowhere"};
  const ProgramResult missing = run_program({"merge", plan_.string(), "-o", merged_.string()}, without);
  EXPECT_EQ(missing.exit_code, 5) << missing.err;
  EXPECT_NE(missing.out.find("--array=0-1"), std::string::npos) << missing.out;
  EXPECT_EQ(run_program({"run", plan_.string(), "--shard", "0"}, without).exit_code, 3) << "there is none";

  const std::vector<std::string> many = {"plan",     "sweep",       "corner",
                                         "--size",   "16x9",        "--light",
                                         "0",        "--vary",      "shadow.constant-bias=0:0.1:1100",
                                         "--shards", "1100",        "--force",
                                         "-o",       plan_.string()};
  ASSERT_EQ(run_program(many).exit_code, 0);
  const ProgramResult beyond = merge();
  EXPECT_EQ(beyond.out.find("--array"), std::string::npos) << beyond.out;
  EXPECT_NE(beyond.out.find("task 1099 is beyond the default MaxArraySize of 1001"), std::string::npos) << beyond.out;
}

TEST_F(Shards, A_plan_needs_a_number_of_shards_and_replaces_another_one_only_by_force) {
  EXPECT_EQ(plan("corner", {}).exit_code, 2);
  EXPECT_EQ(plan("corner", {"--shards", "2", "--cells-per-shard", "3"}).exit_code, 2);
  const ProgramResult commands = plan("corner", {"--shards", "2", "--commands"});
  EXPECT_EQ(commands.exit_code, 0);
  EXPECT_EQ(commands.out,
            "umbrameter run " + plan_.string() + " --shard 0\numbrameter run " + plan_.string() + " --shard 1\n");
  ASSERT_EQ(run("0").exit_code, 0);
  EXPECT_EQ(plan("corner", {"--shards", "2"}).exit_code, 2);
  fs::path other = folder_ / "other";
  fs::create_directories(other / "scene");
  std::swap(plan_, other);
  EXPECT_EQ(plan("corner", {"--shards", "2", "--force"}).exit_code, 2) << "a folder that is no plan is left alone";
  EXPECT_TRUE(fs::exists(plan_ / "scene"));
  std::swap(plan_, other);
  EXPECT_EQ(plan("corner", {"--minutes-per-shard", "10", "--force"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(plan_ / "shards/0.shard"));
  EXPECT_EQ(run("1").exit_code, 2) << "one shard of ten minutes is enough";
}

}  // namespace
}  // namespace umbrameter
