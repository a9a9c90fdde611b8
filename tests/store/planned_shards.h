// A plan of a fake sweep, and results of its shards.
#pragma once

#include <string>

#include "store/merge_shards.h"
#include "store/shard_file.h"
#include "store/shard_plan.h"
#include "store/stored_sweep.h"
#include "tests/store/fake_sweep.h"

namespace umbrameter {

/// Of the measured columns.
inline std::vector<ValueKind> kinds_of(const FakeSweep& sweep) {
  std::vector<ValueKind> kinds;
  for (std::size_t i = sweep.plan.axes.size(); i < sweep.description.columns.size(); ++i) {
    kinds.push_back(sweep.description.columns[i].kind);
  }
  return kinds;
}

/// Shards of as many groups as can be equal.
inline ShardPlan plan_of(const FakeSweep& sweep, std::size_t shards) {
  ShardPlan plan;
  plan.identity = {{"resolution", "256"}, {"device", "GPU"}, {"algorithms", "1234"}};
  plan.cells = sweep.plan.cells;
  plan.parts = parts_of_group(sweep.plan);
  plan.kinds = kinds_of(sweep);
  const std::size_t groups = count_groups(sweep.plan);
  for (std::size_t i = 0; i < shards; ++i) {
    const std::size_t first = groups * i / shards;
    plan.shards.push_back({first, groups * (i + 1) / shards - first, 60.0});
  }
  return plan;
}

inline ShardManifest manifest_of(const ShardPlan& plan, std::size_t shard) {
  ShardManifest manifest;
  manifest.plan = plan.id;
  manifest.shard = shard;
  manifest.program = plan.program;
  manifest.measured_by = {{"device", "GPU"}, {"algorithms", "1234"}};
  manifest.maker = "maker";
  manifest.host = "host";
  manifest.seconds = 60.0;
  return manifest;
}

inline std::string rows_of(FakeSweep& sweep, const PlannedShard& shard) {
  std::string rows;
  for_each_joined_group(sweep.plan, shard.first_group, shard.groups, [&](const CellGroup& group) {
    std::vector<std::string> of_group(group.size());
    sweep.evaluate(group, [&](std::size_t place, std::span<const Value> row) { append_values(of_group[place], row); });
    for (const std::string& row : of_group) rows += row;
  });
  return rows;
}

}  // namespace umbrameter
