// Time and memory of planning and merging simulated shards with as many columns as a sweep of shadows has.
// usage: umbrameter_merge_benchmark SHARDS CELLS_PER_SHARD FOLDER
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>

#include "experiments/settings/shard_cuts.h"
#include "results/swept.h"
#include "store/merge_shards.h"
#include "tests/store/planned_shards.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

long peak_mebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

int run(std::size_t shards, std::size_t cells, const fs::path& folder) {
  // Groups of ten cells, whose cells lie apart.
  FakeSweep sweep(
      {"shadow.constant-bias=0:1:10", "shadow.filter=a,b",
       "shadow.resolution=1:" + std::to_string(shards * cells / 20) + ":" + std::to_string(shards * cells / 20)});
  const std::vector<Column> columns = columns_of(CellStatistics(VisibilityStatistics{}));
  sweep.description.columns.resize(sweep.plan.axes.size());
  for (const Column& column : columns) sweep.description.columns.push_back({column, ValueKind::real});

  Clock::time_point start = Clock::now();
  const SweepCosts costs = measure_costs(sweep.plan, 1.0, [](const CellGroup&) {
    GroupTime time;
    time.of_stage[static_cast<std::size_t>(Stage::map)] = 0.01;
    time.rest = 0.01;
    return time;
  });
  ShardPlan plan = plan_of(sweep, 0);
  const std::size_t groups = count_groups(sweep.plan);
  const ShardCuts cuts = cut_into_shards(costs, sweep.plan, shards);
  for (std::size_t i = 0; i < cuts.first.size(); ++i) {
    const std::size_t end = i + 1 < cuts.first.size() ? cuts.first[i + 1] : groups;
    plan.shards.push_back({cuts.first[i], end - cuts.first[i], cuts.seconds[i]});
  }
  write_plan(folder, plan, "");
  std::printf("%zu cells in %zu shards, %zu measured columns\n", sweep.plan.cells, plan.shards.size(), columns.size());
  std::printf("planning        %.2f s\n", seconds_since(start));

  start = Clock::now();
  for (std::size_t i = 0; i < plan.shards.size(); ++i) {
    std::string rows;
    for (std::size_t c = 0; c < plan.shards[i].groups * 10; ++c) {
      std::vector<Value> row;
      for (std::size_t k = 0; k < columns.size(); ++k)
        row.emplace_back(1.0 / static_cast<double>(i * cells + c + k + 1));
      append_values(rows, row);
    }
    write_shard(shard_file(folder, i), manifest_of(plan, i), rows);
  }
  std::printf("writing shards  %.2f s (not part of a merge)\n", seconds_since(start));

  start = Clock::now();
  const Clock::time_point begin = start;
  ScratchRows rows(folder, sweep.plan, kinds_of(sweep));
  const CollectedShards collected = collect_shards(folder, plan, rows);
  std::printf("reading shards  %.2f s, %zu missing\n", seconds_since(start), collected.missing.size());
  start = Clock::now();
  ResultsStore::write(folder, sweep.description, collected.makers, [&](const CellSink& sink) { rows.read(sink); });
  std::printf("writing store   %.2f s\n", seconds_since(start));
  std::printf("merging         %.2f s\n", seconds_since(begin));
  std::printf("peak memory     %ld MiB\n", peak_mebibytes());
  return 0;
}

}  // namespace
}  // namespace umbrameter

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: umbrameter_merge_benchmark SHARDS CELLS_PER_SHARD FOLDER\n");
    return 2;
  }
  return umbrameter::run(std::stoul(argv[1]), std::stoul(argv[2]), argv[3]);
}
