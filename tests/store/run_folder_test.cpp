// Whose an output folder is: which runs are refused, what a later run removes, and what a failed run leaves.
#include "store/run_folder.h"

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <set>

#include "core/error.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> planned = {"experiment.toml", "summary.json", "index.html"};

RunPlan compare_plan(const std::string& experiment = "scene = \"corner\"\n") {
  return {"compare", experiment, planned, false};
}
RunPlan sweep_plan() { return {"sweep", "", planned, true}; }

std::optional<Error> error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error;
  }
  return {};
}

void expect_refused(const fs::path& folder, const RunPlan& plan, const std::string& words, bool force = false) {
  const std::optional<Error> error = error_of([&] { RunFolder(folder, plan, force); });
  ASSERT_TRUE(error.has_value()) << words;
  EXPECT_EQ(error->code(), ExitCode::usage);
  for (const std::string& part : {folder.string(), words}) {
    EXPECT_NE(std::string(error->what()).find(part), std::string::npos) << error->what();
  }
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) files.insert(fs::relative(entry.path(), folder).string());
  }
  return files;
}

// A run that writes its plan's files and these.
void run(const fs::path& path, const RunPlan& plan, const std::vector<std::string>& more, bool force = false,
         bool complete = true) {
  RunFolder folder(path, plan, force);
  folder.begin();
  folder.announce(more);
  for (const std::string& file : planned) put_text(path / file, plan.experiment);
  fs::create_directories(path / "figures");
  for (const std::string& file : more) put_text(path / file, "x");
  folder.finish(complete);
}

struct RunFolderTest : testing::Test {
  TemporaryFolder temporary;
  fs::path out = temporary / "out";
};

TEST_F(RunFolderTest, Another_run_is_refused_without_force_and_nothing_is_touched) {
  run(out, compare_plan(), {"figures/error.svg"});
  const std::set<std::string> before = files_in(out);
  expect_refused(out, {"trace", "", planned, false}, "'umbrameter compare'; choose another folder with -o");
  expect_refused(out, sweep_plan(), "--force");
  expect_refused(out, compare_plan("scene = \"other\"\n"), "--force");
  expect_refused(out, compare_plan(), "--force");
  EXPECT_EQ(files_in(out), before);
}

TEST_F(RunFolderTest, Force_removes_exactly_what_the_earlier_run_recorded) {
  run(out, compare_plan(), {"figures/error.svg", "figures/error.png", "images.exr"});
  put_text(out / "notes.txt", "mine");
  put_text(out / "figures/mine.svg", "mine");
  run(out, {"trace", "", planned, false}, {"figures/truth.svg"}, true);
  EXPECT_EQ(files_in(out), (std::set<std::string>{run_record_name, "experiment.toml", "summary.json", "index.html",
                                                  "figures/truth.svg", "notes.txt", "figures/mine.svg"}));
}

TEST_F(RunFolderTest, Earlier_results_stay_until_the_new_run_begins) {
  run(out, compare_plan(), {"figures/error.svg"});
  const std::set<std::string> before = files_in(out);
  const std::string record = text_of(out / run_record_name);
  {
    RunFolder folder(out, sweep_plan(), true);
    folder.announce({"results.partial.sqlite"});
    put_text(out / "results.partial.sqlite", "");
    EXPECT_NE(text_of(out / run_record_name).find("results.partial.sqlite"), std::string::npos);
  }
  EXPECT_EQ(files_in(out), before) << "a run that fails before it begins leaves everything as it was";
  EXPECT_EQ(text_of(out / run_record_name), record);
}

TEST_F(RunFolderTest, An_unfinished_run_may_be_repeated_and_leaves_nothing_of_its_first_try) {
  {
    RunFolder folder(out, compare_plan(), false);
    folder.begin();
    put_text(out / "experiment.toml", compare_plan().experiment);
    folder.announce({"images.exr"});
    put_text(out / "images.exr", "half");
  }
  expect_refused(out, {"trace", "", planned, false}, "the unfinished results of 'umbrameter compare'");
  expect_refused(out, compare_plan("scene = \"other\"\n"), "--force");
  RunFolder again(out, compare_plan(), false);
  again.begin();
  EXPECT_EQ(files_in(out), std::set<std::string>{run_record_name});
}

TEST_F(RunFolderTest, A_run_with_problems_may_be_repeated) {
  run(out, compare_plan(), {}, false, false);
  EXPECT_FALSE(error_of([&] { run(out, compare_plan(), {}); }).has_value());
  expect_refused(out, compare_plan(), "--force");
}

TEST_F(RunFolderTest, A_sweep_leaves_it_to_its_store_whether_it_continues) {
  run(out, sweep_plan(), {"results.sqlite"});
  EXPECT_FALSE(error_of([&] { RunFolder(out, sweep_plan(), false); }).has_value());
  fs::remove(out / "results.sqlite");
  expect_refused(out, sweep_plan(), "--force");
}

TEST_F(RunFolderTest, A_continued_sweep_keeps_its_store_and_replaces_the_rest) {
  run(out, sweep_plan(), {"results.sqlite", "figures/old.svg"});
  RunFolder folder(out, sweep_plan(), false);
  folder.announce({"results.sqlite"});
  folder.begin();
  EXPECT_EQ(files_in(out), (std::set<std::string>{run_record_name, "results.sqlite"}));
}

TEST_F(RunFolderTest, A_second_run_is_refused_while_one_is_going_also_with_force) {
  std::optional<RunFolder> first;
  first.emplace(out, compare_plan(), false);
  expect_refused(out, compare_plan(), "another run is writing to it");
  expect_refused(out, compare_plan(), "another run is writing to it", true);
  first.reset();
  EXPECT_FALSE(error_of([&] { RunFolder(out, compare_plan(), false); }).has_value());
}

TEST_F(RunFolderTest, Files_of_others_are_kept_and_not_overwritten_without_force) {
  fs::create_directories(out / "figures");
  put_text(out / "notes.txt", "mine");
  put_text(out / "figures/mine.svg", "mine");
  run(out, compare_plan(), {"figures/error.svg"});
  EXPECT_EQ(text_of(out / "notes.txt"), "mine");
  EXPECT_EQ(text_of(out / "figures/mine.svg"), "mine");

  const fs::path theirs = temporary / "theirs";
  fs::create_directories(theirs / "figures");
  put_text(theirs / "figures/error.svg", "mine");
  EXPECT_NE(std::string(error_of([&] {
                          const RunFolder folder(theirs, compare_plan(), false);
                          folder.require_free({"figures/error.svg"});
                        })->what())
                .find("no recorded run wrote it"),
            std::string::npos);
  put_text(theirs / "index.html", "mine");
  expect_refused(theirs, compare_plan(), "index.html");
  EXPECT_EQ(text_of(theirs / "index.html"), "mine");
  EXPECT_EQ(files_in(theirs), (std::set<std::string>{"index.html", "figures/error.svg"}));
  run(theirs, compare_plan(), {}, true);
  EXPECT_EQ(text_of(theirs / "index.html"), compare_plan().experiment);
}

TEST_F(RunFolderTest, Folders_that_a_failed_run_made_are_gone_and_those_that_were_there_stay) {
  { const RunFolder folder(temporary / "a/b/c", compare_plan(), false); }
  EXPECT_FALSE(fs::exists(temporary / "a"));
  fs::create_directories(temporary / "a/b");
  { const RunFolder folder(temporary / "a/b/c/d/", compare_plan(), false); }
  EXPECT_TRUE(fs::exists(temporary / "a/b"));
  EXPECT_FALSE(fs::exists(temporary / "a/b/c"));
  {
    RunFolder folder(temporary / "a/b/c", compare_plan(), false);
    folder.begin();  // nothing written yet
  }
  EXPECT_FALSE(fs::exists(temporary / "a/b/c"));
  put_text(temporary / "a/b/file", "x");
  EXPECT_TRUE(error_of([&] { RunFolder(temporary / "a/b/file/c", compare_plan(), false); }).has_value());
  EXPECT_EQ(text_of(temporary / "a/b/file"), "x");
}

TEST_F(RunFolderTest, Results_of_versions_without_a_record_are_known_by_their_summary_and_page) {
  fs::create_directories(out / "figures");
  put_text(out / "summary.json", R"({"program": {"name": "umbrameter"}, "command": "sweep",
      "files": ["experiment.toml", "sweep.csv", "summary.json", "index.html", "../escape", "/etc/passwd"]})");
  put_text(out / "index.html", R"(<a href="figures/old.svg">SVG</a> <a href="figures/../../escape">)");
  put_text(temporary / "escape", "mine");
  for (const char* file : {"experiment.toml", "sweep.csv", "figures/old.svg", "figures/mine.svg", "notes.txt"}) {
    put_text(out / file, "x");
  }
  expect_refused(out, compare_plan(), "the results of 'umbrameter sweep'");
  RunFolder folder(out, compare_plan(), true);
  folder.begin();
  EXPECT_EQ(files_in(out), (std::set<std::string>{run_record_name, "figures/mine.svg", "notes.txt"}));
  EXPECT_TRUE(fs::exists(temporary / "escape"));
}

TEST_F(RunFolderTest, Results_of_a_later_version_are_replaced_only_by_force) {
  run(out, sweep_plan(), {"results.sqlite"});
  EXPECT_FALSE(error_of([&] { RunFolder(out, sweep_plan(), false); }).has_value()) << "the sweep is drawn again";
  put_text(out / "summary.json", R"({"schema_version": 3})");
  const std::optional<Error> error = error_of([&] { RunFolder(out, sweep_plan(), false); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code(), ExitCode::unreadable_input);
  EXPECT_NE(std::string(error->what()).find("schema version 3, this program reads up to 2"), std::string::npos);
  EXPECT_FALSE(error_of([&] { RunFolder(out, sweep_plan(), true); }).has_value());
}

TEST_F(RunFolderTest, An_interrupted_sweep_of_versions_without_a_record_is_known_by_its_store) {
  fs::create_directories(out);
  put_text(out / "results.partial.sqlite", "x");
  put_text(out / "experiment.toml", "x");
  expect_refused(out, compare_plan(), "the unfinished results of 'umbrameter sweep'");
  EXPECT_FALSE(error_of([&] { RunFolder(out, sweep_plan(), false); }).has_value());
  RunFolder folder(out, compare_plan(), true);
  folder.begin();
  EXPECT_EQ(files_in(out), std::set<std::string>{run_record_name});
}

TEST_F(RunFolderTest, A_record_never_reaches_out_of_its_folder) {
  EXPECT_TRUE(is_recordable("summary.json"));
  EXPECT_TRUE(is_recordable("figures/a.svg"));
  for (const char* name : {"", "figures/", "..", "../a", "/a", "figures/../a", "figures/a/b", "a/b", ".hidden"}) {
    EXPECT_FALSE(is_recordable(name)) << name;
  }
  put_text(temporary / "mine", "mine");
  fs::create_directories(out);
  put_text(out / run_record_name,
           R"({"umbrameter_run": 1, "command": "trace", "complete": true, "files": ["../mine", "a", 7, null]})");
  put_text(out / "a", "x");
  RunFolder folder(out, compare_plan(), true);
  folder.begin();
  EXPECT_EQ(files_in(out), std::set<std::string>{run_record_name});
  EXPECT_EQ(text_of(temporary / "mine"), "mine");
}

TEST_F(RunFolderTest, A_damaged_record_is_unreadable_input) {
  fs::create_directories(out);
  for (const char* text : {"", "{", "[]", "7", "{}", R"({"umbrameter_run": "one"})", R"({"umbrameter_run": 2})"}) {
    put_text(out / run_record_name, text);
    const std::optional<Error> error = error_of([&] { RunFolder(out, compare_plan(), true); });
    ASSERT_TRUE(error.has_value()) << text;
    EXPECT_EQ(error->code(), ExitCode::unreadable_input) << error->what();
    EXPECT_EQ(text_of(out / run_record_name), text);
  }
}

}  // namespace
}  // namespace umbrameter
