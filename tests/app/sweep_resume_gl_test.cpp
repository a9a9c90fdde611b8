// Sweeps that are stopped and started again: what is kept, what is said, and that the end is the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <random>
#include <set>

#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

struct SweepResume : GlRun {};

// Each group has 4 cells and one map. The map is as small as can be, because its texels do not change what is stored.
// Not quiet: notes say what is there already.
std::vector<std::string> sweep(const fs::path& output, int groups, const std::vector<std::string>& more = {}) {
  return words({"sweep", "corner", "-o", output, "--size", "32x18", "--light", "0", "--shadow.fit", "bounds",
                "--shadow.resolution", "16", "--vary", "shadow.constant-bias=0:0.1:4", "--vary",
                "shadow.fit-size=4:8:" + std::to_string(groups)},
               more);
}

// Without plots, which take longest and are not what is tested: a run that is done says that they are missing.
constexpr int done = 5;
ProgramResult run(const std::vector<std::string>& arguments, ProgramOptions options = {}) {
  options.environment.push_back("UMBRAMETER_DATA=/nonexistent");
  return run_program(arguments, options);
}
bool is_done(const ProgramResult& result) {
  return result.exit_code == done && result.err.find(" not drawn: ") != std::string::npos;
}

// Number of cells in "note: 12 of 34 cells are done"; 0 where nothing is said.
std::size_t kept_cells(const std::string& text) {
  const std::size_t end = text.find(" cells are done");
  if (end == std::string::npos) return 0;
  const std::size_t note = text.rfind("note: ", end);
  const std::size_t all = text.find("all ", note);
  return std::stoul(text.substr(all < end ? all + 4 : note + 6));
}

// What a reader takes for the results of a whole sweep.
const std::vector<std::string> results = {"results.sqlite", "sweep.csv", "summary.json", "index.html"};

void expect_same_results(const fs::path& folder, const fs::path& expected) {
  for (const std::string& name : results) {
    EXPECT_EQ(text_of(folder / name), text_of(expected / name)) << name;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    EXPECT_TRUE(fs::exists(expected / entry.path().filename())) << entry.path() << " is left over";
  }
}

void expect_whole_or_absent(const fs::path& folder, const fs::path& expected) {
  for (const std::string& name : results) {
    if (!fs::exists(folder / name)) continue;
    EXPECT_EQ(text_of(folder / name), text_of(expected / name)) << name;
  }
}

// Of what the growing store has not yet taken in; it starts anew when it is large, and when the store is opened again.
std::uintmax_t size_of_journal(const fs::path& folder) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(folder / "results.partial.sqlite-wal", error);
  return error ? 0 : size;
}
constexpr std::uintmax_t few_pages = 20'000;

TEST_F(SweepResume, Fifty_kills_at_random_moments_leave_a_whole_store_and_end_in_the_same_rows) {
  constexpr int groups = 1000;
  const fs::path undisturbed = folder_ / "undisturbed";
  ASSERT_TRUE(is_done(run(sweep(undisturbed, groups))));
  const fs::path folder = folder_ / "killed";
  std::mt19937 random(1);
  const auto seconds_to = [&](double most) { return std::uniform_real_distribution<double>(0.0, most)(random); };
  std::size_t kept = 0;
  int advances = 0;
  for (int kills = 0; kills < 50;) {
    ProgramOptions options;
    options.signal = SIGKILL;
    // One in five at any moment of the start, the others while groups are stored.
    const bool at_start = kills % 5 == 0;
    options.signal_after_seconds = seconds_to(at_start ? 0.5 : 0.05);
    const std::uintmax_t before = size_of_journal(folder);
    if (!at_start) options.signal_counts_from = [&] { return size_of_journal(folder) > std::max(before, few_pages); };
    const ProgramResult result = run(sweep(folder, groups), options);
    expect_whole_or_absent(folder, undisturbed);
    if (is_done(result)) {
      // A fast machine: the rest of the kills go to another sweep.
      expect_same_results(folder, undisturbed);
      fs::remove_all(folder);
      kept = 0;
      continue;
    }
    // The program checks the integrity of what it continues, and would end with 4.
    ASSERT_EQ(result.exit_code, 128 + SIGKILL) << "after " << kills << " kills: " << result.err;
    ++kills;
    const std::size_t found = kept_cells(result.err);
    EXPECT_EQ(found % 4, 0u) << "groups are whole";
    advances += found > kept ? 1 : 0;
    if (found > 0) {
      EXPECT_GE(found, kept);
      kept = found;
    }
  }
  RecordProperty("advances", advances);
  EXPECT_GE(advances, 20) << "kills must strike at work, not at the start";
  const ProgramResult last = run(sweep(folder, groups));
  ASSERT_TRUE(is_done(last)) << last.err;
  RecordProperty("cells_kept_at_last", std::to_string(kept_cells(last.err)));
  expect_same_results(folder, undisturbed);
}

TEST_F(SweepResume, A_kill_while_results_are_written_leaves_each_whole_or_absent) {
  constexpr int groups = 40;
  const fs::path undisturbed = folder_ / "undisturbed";
  ASSERT_TRUE(is_done(run(sweep(undisturbed, groups))));
  std::mt19937 random(2);
  int killed = 0;
  for (int i = 0; i < 8; ++i) {
    const fs::path folder = folder_ / ("killed-" + std::to_string(i));
    ProgramOptions options;
    options.signal = SIGKILL;
    options.signal_counts_from = [&] { return fs::exists(folder / "results.sqlite"); };
    options.signal_after_seconds = std::uniform_real_distribution<double>(0.0, 0.3)(random);
    killed += run(sweep(folder, groups), options).exit_code == 128 + SIGKILL ? 1 : 0;
    expect_whole_or_absent(folder, undisturbed);
    ASSERT_TRUE(is_done(run(sweep(folder, groups))));
    expect_same_results(folder, undisturbed);
  }
  EXPECT_GE(killed, 1) << "kills must strike while results are written";
}

TEST_F(SweepResume, Ctrl_c_says_what_is_kept_and_the_same_command_continues) {
  constexpr int groups = 2000;
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
    const fs::path folder = folder_ / std::to_string(signal);
    ProgramOptions options;
    options.signal = signal;
    const auto is_storing = [&] {
      return fs::exists(folder / "experiment.toml") && size_of_journal(folder) > few_pages;
    };
    options.signal_counts_from = is_storing;
    const ProgramResult stopped = run(sweep(folder, groups, {"--quiet"}), options);
    EXPECT_EQ(stopped.exit_code, code);
    EXPECT_TRUE(is_one_line(stopped.err)) << stopped.err;
    const std::size_t of = stopped.err.find(" of 8000 cells are stored in");
    ASSERT_NE(of, std::string::npos) << stopped.err;
    EXPECT_NE(stopped.err.find("rerun the command to resume"), std::string::npos) << stopped.err;
    const std::string said = stopped.err.substr(stopped.err.rfind(' ', of - 1) + 1);
    // Stopped at once, but with what it counted.
    options.signal_counts_from = [&] { return size_of_journal(folder) > 0; };
    EXPECT_EQ(kept_cells(run(sweep(folder, groups), options).err), std::stoul(said));
    EXPECT_EQ(count_files(folder), 3u) << "the growing store, the experiment and the record of files";
  }
}

TEST_F(SweepResume, A_finished_sweep_is_shown_again_without_being_measured) {
  const fs::path folder = folder_ / "out";
  ASSERT_TRUE(is_done(run(sweep(folder, 3))));
  const fs::path first = folder_ / "first";
  fs::copy(folder, first, fs::copy_options::recursive);
  for (const char* name : {"sweep.csv", "summary.json", "index.html", "images.exr"}) fs::remove(folder / name);
  const ProgramResult again = run(sweep(folder, 3));
  ASSERT_TRUE(is_done(again)) << again.err;
  EXPECT_EQ(kept_cells(again.err), 12u) << again.err;
  expect_same_results(folder, first);
  const ProgramResult anew = run(sweep(folder, 3, {"--force"}));
  ASSERT_TRUE(is_done(anew)) << anew.err;
  EXPECT_EQ(kept_cells(anew.err), 0u) << anew.err;
  expect_same_results(folder, first);
}

TEST_F(SweepResume, Another_sweep_in_the_folder_is_refused_and_can_be_replaced) {
  const fs::path folder = folder_ / "out";
  ASSERT_TRUE(is_done(run(sweep(folder, 3))));
  const std::string csv = text_of(folder / "sweep.csv");
  const auto refuse = [&](const std::vector<std::string>& more, const std::string& word) {
    const ProgramResult result = run(sweep(folder, 3, words({"--quiet"}, more)));
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find(word), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("--force"), std::string::npos) << result.err;
    EXPECT_EQ(text_of(folder / "sweep.csv"), csv);
  };
  refuse({"--truth.spp", "8"}, "truth.spp is '256' in the folder and '8' in this command");
  refuse({"--vary", "shadow.filter=box"}, "shadow.filter is set only in this command");
  // The same words, but another file behind them.
  ASSERT_EQ(run({"scene", "corner", "-o", folder_ / "scene.glb"}).exit_code, 0);
  const auto by_file = [&](const std::string& more) {
    return run({"sweep", folder_ / "scene.glb", "-o", folder_ / "file", "--size", "32x18", "--light", "0", "--vary",
                "shadow.resolution=16,32", "--quiet", more});
  };
  ASSERT_TRUE(is_done(by_file("--json")));
  ASSERT_EQ(run({"scene", "trench", "-o", folder_ / "scene.glb"}).exit_code, 0);
  const ProgramResult changed = by_file("--json");
  EXPECT_EQ(changed.exit_code, 2);
  EXPECT_NE(changed.err.find("content of the scene"), std::string::npos) << changed.err;
  EXPECT_TRUE(is_done(by_file("--force")));
}

// Changes a hundredth of the number that follows the word, the occurrence-th time.
void change_number(const fs::path& file, const std::string& word, std::size_t occurrence) {
  std::string bytes = text_of(file);
  std::size_t place = 0;
  for (std::size_t i = 0; i <= occurrence; ++i) {
    place = bytes.find('"' + word + "\":", place) + word.size() + 3;
    ASSERT_LT(place, bytes.size()) << word;
  }
  const std::size_t digit = bytes.find('.', place) + 2;
  ASSERT_TRUE(bytes[digit] >= '0' && bytes[digit] <= '9') << bytes.substr(place, 20);
  bytes[digit] = bytes[digit] == '5' ? '4' : '5';
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST_F(SweepResume, What_decides_which_pixels_count_is_part_of_the_sweep) {
  const fs::path file = folder_ / "scene.glb";
  ASSERT_EQ(run({"scene", "courtyard", "-o", file}).exit_code, 0);
  const auto sweep_file = [&](const fs::path& out, const std::string& axis) {
    return run({"sweep", file, "-o", out, "--size", "32x18", "--light", "spot", "--vary", axis, "--quiet",
                "--truth.spp", "4", "--no-cache"});
  };
  ASSERT_TRUE(is_done(sweep_file(folder_ / "cone", "shadow.resolution=16,32")));
  ASSERT_TRUE(is_done(sweep_file(folder_ / "views", "view.camera=0,1")));
  change_number(file, "outerConeAngle", 0);
  const ProgramResult cone = sweep_file(folder_ / "cone", "shadow.resolution=16,32");
  EXPECT_EQ(cone.exit_code, 2);
  EXPECT_NE(cone.err.find("content of the lights"), std::string::npos) << cone.err;
  ASSERT_EQ(run({"scene", "courtyard", "-o", file}).exit_code, 0);
  change_number(file, "yfov", 1);
  const ProgramResult views = sweep_file(folder_ / "views", "view.camera=0,1");
  EXPECT_EQ(views.exit_code, 2);
  EXPECT_NE(views.err.find("content of the cameras"), std::string::npos) << views.err;
}

TEST_F(SweepResume, A_command_that_makes_no_sense_is_in_nobodys_way) {
  const fs::path folder = folder_ / "out";
  ASSERT_TRUE(is_done(run({"compare", "corner", "-o", folder, "--size", "32x18", "--truth.spp", "4", "--quiet"})));
  const std::string summary = text_of(folder / "summary.json");
  const std::vector<std::string> command = {"sweep",
                                            "corner",
                                            "-o",
                                            folder,
                                            "--size",
                                            "32x18",
                                            "--quiet",
                                            "--truth.spp",
                                            "4",
                                            "--vary",
                                            "ao.radius=0.2,0.5",
                                            "--truth.ao-falloff",
                                            "linear"};
  EXPECT_EQ(run(words(command, {"--truth.ao-distance", "0", "--force"})).exit_code, 2) << "a falloff needs a limit";
  EXPECT_EQ(text_of(folder / "summary.json"), summary);
  EXPECT_TRUE(is_done(run(words(command, {"--truth.ao-distance", "1", "--force"}))));
  EXPECT_NE(text_of(folder / "summary.json"), summary);
}

// All files below the folder, relative to it.
std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) files.insert(fs::relative(entry.path(), folder).string());
  }
  return files;
}

TEST_F(SweepResume, A_folder_holds_one_run_and_force_replaces_exactly_what_it_wrote) {
  const fs::path folder = folder_ / "out";
  const auto compare = [&](const std::vector<std::string>& more) {
    return run(
        words({"compare", "corner", "-o", folder, "--size", "32x18", "--truth.spp", "4", "--quiet", "--light", "lamp"},
              more));
  };
  ASSERT_TRUE(is_done(run(sweep(folder, 3))));
  const std::set<std::string> of_sweep = files_in(folder);
  ASSERT_TRUE(of_sweep.contains("figures/truth_visibility_sun.svg"));
  put_text(folder / "notes.txt", "mine");
  put_text(folder / "figures/pareto_front.svg", "mine");

  const ProgramResult refused = compare({});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(is_one_line(refused.err)) << refused.err;
  EXPECT_NE(refused.err.find("'umbrameter sweep'"), std::string::npos) << refused.err;
  EXPECT_EQ(files_in(folder).size(), of_sweep.size() + 2);

  const ProgramResult replaced = compare({"--force"});
  ASSERT_LE(replaced.exit_code, done) << replaced.err;
  const std::set<std::string> of_compare = files_in(folder);
  for (const char* gone : {"results.sqlite", "sweep.csv", "figures/truth_visibility_sun.svg"}) {
    EXPECT_FALSE(of_compare.contains(gone)) << gone;
  }
  for (const char* there :
       {"notes.txt", "figures/pareto_front.svg", "images.exr", "figures/truth_visibility_lamp.svg"}) {
    EXPECT_TRUE(of_compare.contains(there)) << there;
  }

  const ProgramResult back = run(sweep(folder, 3, {"--quiet"}));
  EXPECT_EQ(back.exit_code, 2);
  EXPECT_NE(back.err.find("'umbrameter compare'"), std::string::npos) << back.err;
  EXPECT_EQ(files_in(folder), of_compare) << "a refused run changes nothing";
  ASSERT_TRUE(is_done(run(sweep(folder, 3, {"--force"}))));
  std::set<std::string> expected = of_sweep;
  expected.insert({"notes.txt", "figures/pareto_front.svg"});
  EXPECT_EQ(files_in(folder), expected);
}

TEST_F(SweepResume, A_run_is_refused_while_a_sweep_is_going_there) {
  const fs::path folder = folder_ / "out";
  ProgramResult second;
  ProgramOptions options;
  options.signal = SIGINT;
  options.signal_counts_from = [&] {
    if (size_of_journal(folder) <= few_pages) return false;
    if (second.exit_code < 0) {
      second = run({"compare", "corner", "-o", folder, "--size", "32x18", "--truth.spp", "4", "--quiet", "--force"});
    }
    return true;
  };
  EXPECT_EQ(run(sweep(folder, 10'000), options).exit_code, 130);
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.err.find("another run is writing to it"), std::string::npos) << second.err;
  EXPECT_FALSE(fs::exists(folder / "summary.json"));
}

TEST_F(SweepResume, What_is_measured_comes_back_from_the_experiment_file) {
  const std::vector<std::string> small = {"--size", "32x18", "--quiet", "--truth.spp", "4"};
  ASSERT_TRUE(is_done(
      run(words({"sweep", "corner", "-o", folder_ / "first", "--measure", "ao", "--vary", "view.camera=0,1"}, small))));
  const ProgramResult again =
      run({"sweep", "-c", folder_ / "first/experiment.toml", "-o", folder_ / "second", "--quiet"});
  ASSERT_TRUE(is_done(again)) << again.err;
  EXPECT_EQ(text_of(folder_ / "second/sweep.csv"), text_of(folder_ / "first/sweep.csv"));
}

TEST_F(SweepResume, A_damaged_store_is_unreadable_input) {
  const fs::path folder = folder_ / "out";
  fs::create_directory(folder);
  put_text(folder / "results.partial.sqlite", std::string(5000, 'x'));
  const ProgramResult result = run(sweep(folder, 3, {"--quiet"}));
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_NE(result.err.find("damaged"), std::string::npos) << result.err;
  EXPECT_TRUE(is_done(run(sweep(folder, 3, {"--force"}))));
}

TEST_F(SweepResume, An_unfinished_sweep_leaves_no_older_results_that_look_like_its_own) {
  const fs::path folder = folder_ / "out";
  ASSERT_TRUE(is_done(run(sweep(folder, 3))));
  ProgramOptions options;
  options.signal = SIGINT;
  options.signal_counts_from = [&] { return !fs::exists(folder / "sweep.csv") && size_of_journal(folder) > few_pages; };
  EXPECT_EQ(run(sweep(folder, 2000, {"--force"}), options).exit_code, 130);
  EXPECT_TRUE(fs::exists(folder / "results.partial.sqlite"));
  for (const std::string& name : results) EXPECT_FALSE(fs::exists(folder / name)) << name;
  EXPECT_FALSE(fs::exists(folder / "images.exr"));
}

TEST_F(SweepResume, A_full_disk_keeps_what_was_stored_and_the_sweep_ends_once_there_is_room) {
  constexpr int groups = 400;
  const fs::path undisturbed = folder_ / "undisturbed";
  ASSERT_TRUE(is_done(run(sweep(undisturbed, groups))));
  const std::string disk = folder_ / "disk";
  fs::create_directory(disk);
  // A mount namespace of its own; needs root or unprivileged user namespaces.
  const std::string mount = "mount -t tmpfs -o size=256k none '" + disk + "'";
  if (std::system(("unshare -rm sh -c \"" + mount + "\" 2>/dev/null").c_str()) != 0) {
    GTEST_SKIP() << "no tmpfs can be mounted here";
  }
  const std::string kept = folder_ / "kept";
  ProgramOptions options;
  options.wrapper = {"unshare",
                     "-rm",
                     "sh",
                     "-c",
                     mount + " && { \"$@\"; code=$?; cp -r '" + disk + "/out' '" + kept + "'; exit $code; }",
                     "sh"};
  const ProgramResult full = run(sweep(disk + "/out", groups, {"--quiet"}), options);
  EXPECT_EQ(full.exit_code, 5);
  EXPECT_TRUE(is_one_line(full.err)) << full.err;
  EXPECT_NE(full.err.find("No space left on device"), std::string::npos) << full.err;
  for (const std::string& name : results) EXPECT_FALSE(fs::exists(fs::path(kept) / name)) << name;
  const ProgramResult more = run(sweep(kept, groups));
  ASSERT_TRUE(is_done(more)) << more.err;
  EXPECT_GT(kept_cells(more.err), 0u);
  EXPECT_LT(kept_cells(more.err), 4u * groups);
  expect_same_results(kept, undisturbed);
}

}  // namespace
}  // namespace umbrameter
