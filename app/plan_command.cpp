#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/dry_run.h"
#include "app/planned_sweep.h"
#include "core/standard_streams.h"
#include "experiments/settings/shard_cuts.h"
#include "present/run_output.h"
#include "reports/files/output.h"
#include "reports/files/text_layout.h"
#include "scenes/gltf.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

constexpr const char* scene_folder = "scene";
constexpr double cost_budget = 20.0;  // seconds

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
  return count_shards_within(costs, plan, 60.0 * options.minutes_per_shard);
}

std::vector<PlannedShard> planned_shards(const ShardCuts& cuts, std::size_t groups) {
  std::vector<PlannedShard> shards;
  for (std::size_t i = 0; i < cuts.first.size(); ++i) {
    const std::size_t end = i + 1 < cuts.first.size() ? cuts.first[i + 1] : groups;
    shards.push_back({cuts.first[i], end - cuts.first[i], cuts.seconds[i]});
  }
  return shards;
}

// Loads the sweep as a shard does, and measures what that and its groups take. References are traced, as on a machine
// that has not traced them yet.
SweepCosts costs_of(SweepRun& sweep, StoreDescription& description, const Console& console) {
  const auto start = std::chrono::steady_clock::now();
  sweep.load(console);
  description = sweep.description();
  const double loading = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  SweepCosts costs =
      measure_costs(*sweep.stages, {sweep.experiment, sweep.axes, sweep.plan, sweep.statistics}, cost_budget);
  costs.start_seconds += loading;
  return costs;
}

void show_plan(const Console& console, const fs::path& folder, const ShardPlan& plan, const ShardCuts& cuts,
               double start) {
  double all = 0.0;
  double longest = 0.0;
  for (const double seconds : cuts.seconds) {
    all += seconds;
    longest = std::max(longest, seconds);
  }
  const double starts = start * static_cast<double>(cuts.seconds.size() - 1);
  const double repeated = std::max(0.0, all - cuts.undivided - starts);
  if (console.json) {
    const nlohmann::ordered_json json = {{"cells", plan.cells},     {"shards", plan.shards.size()},
                                         {"seconds", all},          {"longest_seconds", longest},
                                         {"start_seconds", starts}, {"repeated_seconds", repeated}};
    write_to(stdout, json.dump(2) + "\n");
  }
  const auto time = [](double seconds) { return time_text(std::ceil(seconds)); };
  print_line(console, fmt::format("{} cells in {} shards of at most about {}; all of them about {}",
                                  grouped(plan.cells), grouped(plan.shards.size()), time(longest), time(all)));
  add_line(console,
           fmt::format("undivided about {}; starting shards adds {}, what they repeat adds {}{}", time(cuts.undivided),
                       time(starts), time(repeated),
                       plan.parts > 1 ? ": several shards draw the same map or look up the same reference" : ""));
  add_line(console, fmt::format("next: {}, of 0 to {}", command_of(folder, "K"), plan.shards.size() - 1));
}

}  // namespace

ExitCode run_plan(const CommandLine& line, const Console& console) {
  const fs::path& folder = line.output;
  require_division(line.plan);
  require_free(folder, line.force);
  CommandLine of_sweep = line;
  of_sweep.no_cache = true;
  SweepRun sweep(of_sweep, make_experiment(of_sweep));
  StoreDescription description;
  const SweepCosts costs = costs_of(sweep, description, console);

  const std::size_t wanted = count_shards(line.plan, costs, sweep.plan);
  const ShardCuts cuts = cut_into_shards(costs, sweep.plan, wanted);
  if (wanted > cuts.first.size()) {
    note(console, fmt::format("the sweep has {0} cells: {0} shards instead of {1}", grouped(cuts.first.size()),
                              grouped(wanted)));
  }
  SweepPlan cut = sweep.plan;
  cut_groups(cut, cuts.parts);
  ShardPlan plan;
  plan.presets = line.presets;
  plan.identity = portable_identity(description);
  plan.cells = sweep.plan.cells;
  plan.parts = cuts.parts;
  plan.kinds = measured_kinds(description, sweep.plan);
  plan.shards = planned_shards(cuts, count_groups(cut));

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

  if (!line.plan.commands) {
    show_plan(console, folder, plan, cuts, costs.start_seconds);
    return ExitCode::ok;
  }
  for (std::size_t i = 0; i < plan.shards.size(); ++i) {
    write_to(stdout, command_of(folder, std::to_string(i)) + "\n");
  }
  return ExitCode::ok;
}

}  // namespace umbrameter
