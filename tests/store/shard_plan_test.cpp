// The plan of a divided sweep: its file, lists of shards, tasks of arrays, and the state of its shards.
#include "store/shard_plan.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

#include "core/error.h"
#include "reports/files/output.h"
#include "store/shard_state.h"
#include "tests/store/planned_shards.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;
using Shards = std::vector<std::size_t>;

const std::vector<std::string> axes = {"shadow.constant-bias=0:1:3", "shadow.resolution=1,2,4,8"};

template <class Action>
void expect_error(ExitCode code, const std::string& text, const Action& action) {
  try {
    action();
    ADD_FAILURE() << "nothing thrown: " << text;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

TEST(ShardPlan, A_plan_is_read_as_it_was_written) {
  const TemporaryFolder folder;
  ShardPlan plan = plan_of(FakeSweep(axes), 2);
  plan.scene_files = {"scene/a.glb"};
  plan.presets = {"godot"};
  write_plan(folder.path(), plan, "seed = 1\n");
  const ShardPlan read = read_plan(folder.path());
  EXPECT_EQ(read.id, plan.id);
  EXPECT_EQ(read.scene_files, plan.scene_files);
  EXPECT_EQ(read.presets, plan.presets);
  EXPECT_EQ(read.identity, plan.identity);
  ASSERT_EQ(read.shards.size(), 2u);
  EXPECT_EQ(read.shards[1].first_group, 2u);
  EXPECT_EQ(read.shards[1].groups, 2u);
  EXPECT_TRUE(fs::is_directory(folder / "shards"));
}

TEST(ShardPlan, A_plan_that_was_changed_or_has_another_experiment_is_refused) {
  const TemporaryFolder folder;
  ShardPlan plan = plan_of(FakeSweep(axes), 2);
  write_plan(folder.path(), plan, "seed = 1\n");
  const std::string text = text_of(folder / "plan.json");
  std::string changed = text;
  changed.replace(changed.find("\"256\""), 5, "\"512\"");
  write_text(folder / "plan.json", changed);
  expect_error(ExitCode::unreadable_input, "changed after planning", [&] { read_plan(folder.path()); });
  write_text(folder / "plan.json", text.substr(0, text.size() / 2));
  expect_error(ExitCode::unreadable_input, "damaged", [&] { read_plan(folder.path()); });
  write_text(folder / "plan.json", text);
  write_text(folder / "experiment.toml", "seed = 2\n");
  expect_error(ExitCode::unreadable_input, "experiment.toml", [&] { read_plan(folder.path()); });
  fs::remove(folder / "plan.json");
  expect_error(ExitCode::unreadable_input, "no plan", [&] { read_plan(folder.path()); });
}

TEST(ShardPlan, A_plan_of_another_version_is_refused) {
  const TemporaryFolder folder;
  ShardPlan plan = plan_of(FakeSweep(axes), 2);
  write_plan(folder.path(), plan, "");
  std::string text = text_of(folder / "plan.json");
  const std::string version = "\"" + program_version() + "\"";
  text.replace(text.find(version), version.size(), "\"9.9.9\"");
  write_text(folder / "plan.json", text);
  expect_error(ExitCode::usage, "umbrameter 9.9.9 planned it", [&] { read_plan(folder.path()); });
}

TEST(ShardPlan, A_round_that_a_tuning_adds_leaves_the_results_of_earlier_rounds_valid) {
  const TemporaryFolder folder;
  ShardPlan plan = plan_of(FakeSweep(axes), 2);
  PlannedTuning& tuning = plan.tuning.emplace();
  tuning.options = {{"scene", "corner"}, {"minimize", "mae"}};
  tuning.costs = {{1.0 / 3.0, 0.1}};
  tuning.rounds.push_back({"", {{"point", {0.1, std::int64_t{3}, std::string("box"), true}}}, 0});
  write_plan(folder.path(), plan, "seed = 1\n");
  const ShardPlan first = read_plan(folder.path());
  EXPECT_EQ(first.tuning->rounds[0].points[0].values, tuning.rounds[0].points[0].values);
  EXPECT_EQ(first.tuning->costs[0].reference, 1.0 / 3.0);
  EXPECT_EQ(first.tuning->options, tuning.options);

  plan = first;
  plan.tuning->rounds.push_back({"", {{"scan", {0.2}}}, plan.shards.size()});
  plan.shards.push_back({4, 1, 1.0});
  write_plan(folder.path(), plan, "seed = 1\n");
  const ShardPlan second = read_plan(folder.path());
  EXPECT_NE(second.id, first.id);
  EXPECT_EQ(id_of(second, 1), id_of(first, 1));
  EXPECT_NE(id_of(second, 2), id_of(second, 1));
  ShardManifest manifest = manifest_of(second, 1);
  manifest.plan = id_of(first, 1);
  EXPECT_EQ(objection_to(manifest, second, 1), "");
  EXPECT_EQ(objection_to(manifest, second, 2), "it is a duplicate of shard 1");
  manifest.shard = 2;
  EXPECT_EQ(objection_to(manifest, second, 2), "it belongs to another plan");
}

TEST(ShardPlan, Another_device_is_refused_with_both_names) {
  const ShardPlan plan = plan_of(FakeSweep(axes), 2);
  EXPECT_NO_THROW(require_planned("plan", plan, plan.identity));
  auto other = plan.identity;
  other[1].second = "another GPU";
  expect_error(ExitCode::usage, "the device is 'GPU' in the plan and 'another GPU' here",
               [&] { require_planned("plan", plan, other); });
}

TEST(ShardPlan, A_list_of_shards_is_read_and_written_in_the_form_of_Slurm) {
  EXPECT_EQ(parse_shards("7,3,8-9,7", 10), (Shards{3, 7, 8, 9}));
  EXPECT_EQ(shards_text({3, 7, 8, 9}), "3,7-9");
  EXPECT_EQ(shards_text({}), "");
  for (const char* text : {"", "a", "3,", "5-3", "-1", "1-2-3", "3 4"}) {
    expect_error(ExitCode::usage, "it is no list of shards", [&] { parse_shards(text, 10); });
  }
  expect_error(ExitCode::usage, "the plan has the shards 0 to 9", [] { parse_shards("3-10", 10); });
}

TEST(ShardPlan, The_task_of_an_array_is_its_index_or_the_shard_at_that_place_of_the_list) {
  for (const char* name : {"SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX", "AWS_BATCH_JOB_ARRAY_INDEX"}) {
    setenv(name, "2", 1);
    EXPECT_EQ(shard_of_environment(), "2") << name;
    setenv("UMBRAMETER_SHARDS", "3,7-9", 1);
    EXPECT_EQ(shard_of_environment(), "8") << name;
    setenv(name, "4", 1);
    expect_error(ExitCode::usage, "lists only 4 shards", [] { shard_of_environment(); });
    unsetenv("UMBRAMETER_SHARDS");
    unsetenv(name);
  }
  expect_error(ExitCode::usage, "is set", [] { shard_of_environment(); });
}

TEST(ShardState, A_shard_waits_runs_fails_is_lost_or_is_done) {
  using Kind = ShardState::Kind;
  const TemporaryFolder folder;
  FakeSweep sweep(axes);
  ShardPlan plan = plan_of(sweep, 4);
  write_plan(folder.path(), plan, "");
  const RunningMark running(folder.path(), 1);
  {
    RunningMark mark(folder.path(), 2);
    mark.fail("no driver");
  }
  write_shard(shard_file(folder.path(), 3), manifest_of(plan, 3), rows_of(sweep, plan.shards[3]));
  std::vector<ShardState> states = shard_states(folder.path(), plan);
  EXPECT_EQ(states[0].kind, Kind::waiting);
  EXPECT_EQ(states[1].kind, Kind::running);
  EXPECT_EQ(states[1].host, host_name());
  EXPECT_EQ(states[2].kind, Kind::failed);
  EXPECT_EQ(states[2].problem, "no driver");
  EXPECT_EQ(states[3].kind, Kind::done);
  // Three shards of 60 s are left, one process runs, and a shard takes what was planned.
  EXPECT_DOUBLE_EQ(seconds_left(plan, states), 180.0);
  fs::last_write_time(shard_file(folder.path(), 1, "running"), fs::file_time_type::clock::now() - 2 * lost_after);
  states = shard_states(folder.path(), plan);
  EXPECT_EQ(states[1].kind, Kind::lost);
  EXPECT_LT(seconds_left(plan, states), 0.0);
}

}  // namespace
}  // namespace umbrameter
