// Results of shards put together: the same bytes as the undivided sweep, and what is wrong with a result.
#include "store/merge_shards.h"

#include <gtest/gtest.h>

#include <functional>

#include "reports/files/output.h"
#include "tests/store/planned_shards.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

struct MergeShards : testing::Test {
  // The axis that runs fastest is an outer one: the cells of a group lie apart.
  MergeShards() : sweep({"shadow.constant-bias=0:1:5", "shadow.filter=a,b", "shadow.resolution=1:40:40"}) {
    sweep.description.maker = "maker";
    plan = plan_of(sweep, 7);
    write_plan(folder.path(), plan, "");
    for (std::size_t shard = 0; shard < plan.shards.size(); ++shard) write(shard, manifest_of(plan, shard));
  }
  void write(std::size_t shard, const ShardManifest& manifest) {
    write_shard(file(shard), manifest, rows_of(sweep, plan.shards[shard]));
  }
  fs::path file(std::size_t shard) const { return shard_file(folder.path(), shard); }

  CollectedShards collect() const {
    ScratchRows rows(folder.path(), sweep.plan, kinds_of(sweep));
    return collect_shards(folder.path(), plan, rows);
  }
  // One line that names the file, and the shard is to be run again.
  void expect_broken(std::size_t shard, const std::string& why) const {
    const CollectedShards collected = collect();
    EXPECT_EQ(collected.missing, std::vector<std::size_t>{shard});
    ASSERT_EQ(collected.problems.size(), 1u);
    const std::string& problem = collected.problems.front();
    EXPECT_TRUE(problem.starts_with(file(shard).string())) << problem;
    EXPECT_NE(problem.find(why), std::string::npos) << problem;
    EXPECT_EQ(problem.find('\n'), std::string::npos) << problem;
  }

  const TemporaryFolder folder;
  FakeSweep sweep;
  ShardPlan plan;
};

TEST_F(MergeShards, The_merged_store_has_the_bytes_of_the_undivided_sweep) {
  const fs::path undivided = folder / "undivided";
  const fs::path merged = folder / "merged";
  fs::create_directory(undivided);
  fs::create_directory(merged);
  sweep.run(undivided);
  ScratchRows rows(merged, sweep.plan, kinds_of(sweep));
  const CollectedShards collected = collect_shards(folder.path(), plan, rows);
  EXPECT_TRUE(collected.missing.empty());
  EXPECT_TRUE(collected.problems.empty());
  EXPECT_EQ(rows.count(), 400u);
  ResultsStore::write(merged, sweep.description, collected.makers, [&](const CellSink& sink) { rows.read(sink); });
  EXPECT_EQ(text_of(merged / "results.sqlite"), text_of(undivided / "results.sqlite"));
  EXPECT_EQ(std::distance(fs::directory_iterator(merged), fs::directory_iterator()), 1) << "nothing else is left";
}

TEST_F(MergeShards, A_missing_shard_is_listed_and_the_rows_of_the_others_are_there) {
  fs::remove(file(2));
  fs::remove(file(6));
  ScratchRows rows(folder.path(), sweep.plan, kinds_of(sweep));
  const CollectedShards collected = collect_shards(folder.path(), plan, rows);
  EXPECT_EQ(collected.missing, (std::vector<std::size_t>{2, 6}));
  EXPECT_TRUE(collected.problems.empty());
  const std::size_t lost = 5 * (plan.shards[2].groups + plan.shards[6].groups);
  EXPECT_EQ(rows.count(), 400u - lost);
  std::size_t read = 0;
  rows.read([&](std::size_t cell, std::span<const Value> values) {
    ++read;
    EXPECT_EQ(values[3], Value(static_cast<std::int64_t>(cell))) << "the fake sweep measures the number of the cell";
    EXPECT_EQ(values[2], sweep.plan.axes[2].values[cell % 40]);
  });
  EXPECT_EQ(read, rows.count());
}

TEST_F(MergeShards, A_truncated_shard_is_broken) {
  for (const std::size_t size : {fs::file_size(file(3)) - 1, fs::file_size(file(3)) / 2}) {
    fs::resize_file(file(3), size);
    expect_broken(3, "it is truncated");
  }
  fs::resize_file(file(3), 0);
  expect_broken(3, "it is no result of a shard");
}

TEST_F(MergeShards, A_flipped_bit_anywhere_breaks_a_shard) {
  const std::string whole = text_of(file(3));
  for (std::size_t at = 0; at < whole.size(); at += 37) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 4);
    write_text(file(3), flipped);
    const CollectedShards collected = collect();
    EXPECT_EQ(collected.missing, std::vector<std::size_t>{3}) << "byte " << at;
    EXPECT_EQ(collected.problems.size(), 1u) << "byte " << at;
  }
}

TEST_F(MergeShards, A_shard_of_another_plan_is_broken) {
  ShardManifest manifest = manifest_of(plan, 4);
  manifest.plan = "another";
  write(4, manifest);
  expect_broken(4, "it belongs to another plan");
}

TEST_F(MergeShards, A_shard_of_another_version_or_kind_of_device_is_broken) {
  ShardManifest manifest = manifest_of(plan, 4);
  manifest.program = "9.9.9";
  write(4, manifest);
  expect_broken(4, "umbrameter 9.9.9 measured it");
  manifest = manifest_of(plan, 4);
  manifest.measured_by[0].second = "another GPU";
  write(4, manifest);
  expect_broken(4, "its device is 'another GPU', that of the plan is 'GPU'");
}

TEST_F(MergeShards, A_copy_of_another_shard_is_a_duplicate) {
  fs::copy_file(file(1), file(5), fs::copy_options::overwrite_existing);
  expect_broken(5, "it is a duplicate of shard 1");
}

TEST_F(MergeShards, A_file_under_the_name_of_no_shard_is_named_and_ignored) {
  fs::copy_file(file(1), folder / "shards/1 (copy).shard");
  const CollectedShards collected = collect();
  EXPECT_TRUE(collected.missing.empty());
  ASSERT_EQ(collected.problems.size(), 1u);
  EXPECT_NE(collected.problems.front().find("1 (copy).shard: the plan has no shard of this name"), std::string::npos);
}

TEST_F(MergeShards, A_shard_with_another_number_of_cells_is_broken) {
  write_shard(file(2), manifest_of(plan, 2), std::string(16, '\0'));
  expect_broken(2, "it has another number of cells");
}

TEST_F(MergeShards, Everyone_who_measured_and_every_note_is_kept_once) {
  ShardManifest manifest = manifest_of(plan, 6);
  manifest.maker = "another maker";
  manifest.notes = {"a note"};
  write(6, manifest);
  manifest.shard = 5;
  write(5, manifest);
  const CollectedShards collected = collect();
  EXPECT_EQ(collected.makers, (std::vector<std::string>{"maker", "another maker"}));
  EXPECT_EQ(collected.notes, std::vector<std::string>{"a note"});
}

}  // namespace
}  // namespace umbrameter
