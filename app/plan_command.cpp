#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/dry_run.h"
#include "app/planned_sweep.h"
#include "core/standard_streams.h"
#include "present/run_output.h"
#include "reports/files/output.h"
#include "reports/files/text_layout.h"
#include "scenes/gltf.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

constexpr const char* scene_folder = "scene";
constexpr double cost_budget = 10.0;  // seconds

void require_division(const PlanOptions& options) {
  if (options.shards > 0 || options.cells_per_shard > 0 || options.minutes_per_shard > 0.0) return;
  throw Error(ExitCode::usage, "plan", "nothing says how many shards",
              "add --shards N, --cells-per-shard N or --minutes-per-shard X");
}

// Also what is left of a plan when an engine has removed plan.json to have it made again.
bool holds_plan(const fs::path& folder) {
  return is_there(folder / "plan.json") || (is_there(folder / "experiment.toml") && is_there(folder / "shards"));
}

void require_free(const fs::path& folder, bool force) {
  std::error_code error;
  if (!fs::exists(folder, error) || fs::is_empty(folder, error)) return;
  const bool is_plan = holds_plan(folder);
  if (is_plan && force) return;
  throw Error(ExitCode::usage, folder.string(), is_plan ? "it holds a plan" : "the folder is not empty",
              is_plan ? "choose another one with -o, or replace the plan and its results with --force"
                      : "choose another one with -o");
}

void remove_plan(const fs::path& folder) {
  if (!holds_plan(folder)) return;
  for (const char* name : {"plan.json", "experiment.toml", scene_folder, "shards"}) {
    std::error_code error;
    fs::remove_all(folder / name, error);
    if (error) throw_write_error(folder / name, error.value());
  }
}

// Copies the file and what it refers to; returns its path relative to the plan.
fs::path copy_scene(const fs::path& scene, const fs::path& folder) {
  std::vector<fs::path> files = files_of_gltf(scene);
  files.push_back(scene.filename());
  for (const fs::path& file : files) {
    const fs::path to = folder / scene_folder / file;
    std::error_code error;
    fs::create_directories(to.parent_path(), error);
    if (error) throw_write_error(to.parent_path(), error.value());
    copy_whole(scene.parent_path() / file, to);
  }
  return fs::path(scene_folder) / scene.filename();
}

std::size_t count_shards(const PlanOptions& options, const SweepCosts& costs, const SweepPlan& plan) {
  if (options.shards > 0) return options.shards;
  if (options.cells_per_shard > 0) return (plan.cells + options.cells_per_shard - 1) / options.cells_per_shard;
  // Each shard begins with a group that finds nothing to share.
  const std::size_t groups = count_groups(plan);
  const double all = seconds_of(costs, 0, groups) - costs.first_seconds;
  const double each = 60.0 * options.minutes_per_shard - costs.first_seconds;
  if (each <= all / static_cast<double>(groups)) return groups;
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(all / each)));
}

std::vector<PlannedShard> planned_shards(const SweepCosts& costs, std::size_t groups, std::size_t count) {
  std::vector<PlannedShard> shards;
  const std::vector<std::size_t> first = cut_into_shards(costs, groups, count);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const std::size_t end = i + 1 < first.size() ? first[i + 1] : groups;
    shards.push_back({first[i], end - first[i], seconds_of(costs, first[i], end)});
  }
  return shards;
}

}  // namespace

ExitCode run_plan(const CommandLine& line, const Console& console) {
  const fs::path& folder = line.output;
  require_division(line.plan);
  require_free(folder, line.force);
  SweepRun sweep(line, make_experiment(line));
  sweep.load(console);
  const StoreDescription description = sweep.description();
  const SweepCosts costs =
      measure_costs(*sweep.stages, {sweep.experiment, sweep.axes, sweep.plan, sweep.statistics}, cost_budget);

  const std::size_t groups = count_groups(sweep.plan);
  const std::size_t wanted = count_shards(line.plan, costs, sweep.plan);
  if (wanted > groups) {
    note(console, fmt::format("the sweep has {} groups of cells, which are not divided: {} shards instead of {}",
                              grouped(groups), grouped(groups), grouped(wanted)));
  }
  ShardPlan plan;
  plan.presets = line.presets;
  plan.identity = portable_identity(description);
  plan.cells = sweep.plan.cells;
  plan.shards = planned_shards(costs, groups, wanted);

  prepare_output_folder(folder);
  remove_plan(folder);
  Experiment stored = sweep.given;
  if (fs::is_regular_file(stored.scene)) {
    plan.scene_file = line.plan.by_reference
                          ? fs::path(stored.scene).lexically_relative(fs::absolute(folder).lexically_normal()).string()
                          : copy_scene(stored.scene, folder).string();
    stored.scene = plan.scene_file;
  }
  write_plan(folder, plan, experiment_text(stored));

  if (line.plan.commands) {
    for (std::size_t i = 0; i < plan.shards.size(); ++i) {
      write_to(stdout, command_of(folder, std::to_string(i)) + "\n");
    }
    return ExitCode::ok;
  }
  double longest = 0.0;
  for (const PlannedShard& shard : plan.shards) longest = std::max(longest, shard.seconds);
  if (console.json) {
    const nlohmann::ordered_json json = {
        {"cells", plan.cells}, {"shards", plan.shards.size()}, {"seconds", seconds_of(costs, 0, groups)}};
    write_to(stdout, json.dump(2) + "\n");
  }
  print_line(console, fmt::format("{} cells in {} shards of at most about {}; all of them about {}",
                                  grouped(plan.cells), grouped(plan.shards.size()), time_text(std::ceil(longest)),
                                  time_text(std::ceil(seconds_of(costs, 0, groups)))));
  add_line(console, fmt::format("next: {}, of 0 to {}", command_of(folder, "K"), plan.shards.size() - 1));
  return ExitCode::ok;
}

}  // namespace umbrameter
