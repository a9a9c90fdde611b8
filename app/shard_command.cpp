#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/planned_sweep.h"
#include "core/interrupt.h"
#include "core/standard_streams.h"
#include "experiments/sweep/identity.h"
#include "reports/files/output.h"
#include "reports/files/text_layout.h"
#include "store/merge_shards.h"
#include "store/shard_state.h"
#include "store/stored_sweep.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

bool is_done(const fs::path& folder, const ShardPlan& plan, std::size_t shard) {
  if (!is_there(shard_file(folder, shard))) return false;
  try {
    return objection_to(read_shard(shard_file(folder, shard)).manifest, plan, shard).empty();
  } catch (const Error&) {
    return false;
  }
}

// A sweep that is loaded for the first shard and serves the others.
struct ShardRunner {
  const PlannedSweepFolder& planned;
  const Console& console;
  std::optional<SweepRun> sweep{};
  std::string maker{};
  std::size_t notes_of_loading = 0;
  EvaluateGroup evaluate{};
  SweepPlan cut{};

  void load() {
    sweep.emplace(planned.line, planned.given);
    maker = load_planned(planned, *sweep, console).maker;
    notes_of_loading = sweep->stages->notes().size();
    cut = sweep->plan;
    cut_groups(cut, planned.plan.parts);
    evaluate = make_evaluator(*sweep->stages, sweep->experiment, sweep->axes, sweep->statistics);
  }

  void measure(std::size_t shard, RunningMark& mark) {
    const auto started = std::chrono::system_clock::now();
    const auto begin = std::chrono::steady_clock::now();
    if (!sweep) load();
    Stages& stages = *sweep->stages;
    const PlannedShard& part = planned.plan.shards[shard];
    ProgressBar bar(console, fmt::format("shard {}", shard));
    double share = 0.0;
    const auto show = [&] {
      bar.show(share);
      mark.show(std::max(share, 1e-6));
    };
    stages.report_tracing([&](double) { show(); });
    std::string rows;
    std::size_t cells = 0;
    const double all = static_cast<double>(planned.plan.cells) * static_cast<double>(part.groups) /
                       static_cast<double>(count_groups(cut));
    for_each_joined_group(cut, part.first_group, part.groups, [&](const CellGroup& group) {
      throw_if_interrupted("the shard starts over when it is run again");
      std::string of_group;
      evaluate_whole(group, evaluate, [&](std::size_t place, std::span<const Value> measured) {
        std::string row;
        append_values(row, measured);
        if (of_group.empty()) of_group.resize(group.size() * row.size());
        std::memcpy(of_group.data() + place * row.size(), row.data(), row.size());
      });
      rows += of_group;
      cells += group.size();
      share = std::min(1.0, static_cast<double>(cells) / all);
      show();
    });
    stages.report_tracing({});
    const std::vector<std::string>& notes = stages.notes();
    ShardManifest manifest{
        planned.plan.id, shard, program_version(), measuring_identity(stages), maker, host_name(), {}, 0.0, cells, {}};
    manifest.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(started)));
    manifest.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    manifest.notes.assign(notes.begin() + static_cast<std::ptrdiff_t>(notes_of_loading), notes.end());
    write_shard(shard_file(planned.folder, shard), manifest, rows);
    print_line(console, fmt::format("shard {}: {} cells in {}", shard, cells, time_text(std::ceil(manifest.seconds))));
  }
};

}  // namespace

ExitCode run_shards(const CommandLine& line, const Console& console) {
  const PlannedSweepFolder planned = open_plan(line);
  const std::string text = line.plan.shard == "env" ? shard_of_environment() : line.plan.shard;
  remove_abandoned(planned.folder / "shards");
  ShardRunner runner{planned, console};
  std::vector<std::size_t> measured;
  for (const std::size_t shard : parse_shards(text, planned.plan.shards.size())) {
    if (!line.force && is_done(planned.folder, planned.plan, shard)) {
      print_line(console, fmt::format("shard {}: done already; --force measures it again", shard));
      continue;
    }
    RunningMark mark(planned.folder, shard);
    try {
      runner.measure(shard, mark);
      measured.push_back(shard);
    } catch (const Error& error) {
      if (error.code() != ExitCode::interrupted && error.code() != ExitCode::terminated) mark.fail(error.what());
      throw;
    }
  }
  if (console.json) write_to(stdout, nlohmann::ordered_json{{"measured", measured}}.dump(2) + "\n");
  return ExitCode::ok;
}

}  // namespace umbrameter
