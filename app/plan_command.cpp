#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/dry_run.h"
#include "app/plan_folder.h"
#include "app/planned_sweep.h"
#include "app/print_json.h"
#include "app/tune_job.h"
#include "core/standard_streams.h"
#include "experiments/settings/shard_cuts.h"
#include "experiments/stages/work_clock.h"
#include "present/run_output.h"
#include "reports/files/output.h"
#include "reports/files/text_layout.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

void require_division(const PlanOptions& options) {
  if (options.shards > 0 || options.cells_per_shard > 0 || options.minutes_per_shard > 0.0) return;
  throw Error(ExitCode::usage, "plan", "nothing says how many shards",
              "add --shards N, --cells-per-shard N or --minutes-per-shard X");
}

// The options of `plan tune` mean nothing to a sweep.
void require_options_of_sweep(const CommandLine& line) {
  TuneOptions none;
  none.scenes = line.tune.scenes;
  const auto of_sweep = pairs_of(none);
  for (const auto& [name, text] : pairs_of(line.tune)) {
    if (std::ranges::find(of_sweep, std::pair(name, text)) != of_sweep.end()) continue;
    throw Error(ExitCode::usage, "--" + name, "only a tuning has this option", "plan tune, or leave it out");
  }
  if (line.tune.minutes > 0.0) throw Error(ExitCode::usage, "--minutes", "a sweep has no time limit");
  if (line.plan.points_per_round > 0) throw Error(ExitCode::usage, "--points-per-round", "a sweep has no rounds");
  if (line.tune.scenes.size() > 1) {
    throw Error(ExitCode::usage, "plan sweep", "a sweep has one scene", "plan one sweep for each scene");
  }
}

std::size_t count_shards(const PlanOptions& options, const SweepCosts& costs, const SweepPlan& plan) {
  if (options.shards > 0) return options.shards;
  if (options.cells_per_shard > 0) return divide_up(plan.cells, options.cells_per_shard);
  return count_shards_within(costs, plan, 60.0 * options.minutes_per_shard);
}

// Loads the sweep as a shard does, and measures what that and its groups take. References are traced, as on a machine
// that has not traced them yet.
SweepCosts costs_of(SweepRun& sweep, StoreDescription& description, const Console& console) {
  const double start = clock_seconds();
  sweep.load(console);
  description = sweep.description();
  const double loading = clock_seconds() - start;
  SweepCosts costs = measure_costs(sweep);
  costs.start_seconds += loading;
  return costs;
}

void show_plan(const Console& console, const fs::path& folder, const ShardPlan& plan, const ShardCuts& cuts,
               double start) {
  const double all = std::accumulate(cuts.seconds.begin(), cuts.seconds.end(), 0.0);
  const double longest = std::ranges::max(cuts.seconds);
  const double starts = start * static_cast<double>(cuts.seconds.size() - 1);
  const double repeated = std::max(0.0, all - cuts.undivided - starts);
  print_json(console, {{"cells", plan.cells},
                       {"shards", plan.shards.size()},
                       {"seconds", all},
                       {"longest_seconds", longest},
                       {"start_seconds", starts},
                       {"repeated_seconds", repeated}});
  // With a decimal, so that the parts add up to the whole.
  const auto time = [](double seconds) {
    return seconds < 10.0 ? fmt::format("{:.1f} s", seconds) : time_text(seconds);
  };
  print_line(console, fmt::format("{} cells in {} shards of at most about {}; all of them about {}",
                                  grouped(plan.cells), grouped(plan.shards.size()), time(longest), time(all)));
  add_line(console,
           fmt::format("undivided about {}; starting shards adds {}, what they repeat adds {}{}", time(cuts.undivided),
                       time(starts), time(repeated),
                       plan.parts > 1 ? ": several shards draw the same map or look up the same reference" : ""));
  add_line(console, fmt::format("next: {} with K from 0 to {}", command_of(folder, "K"), plan.shards.size() - 1));
}

}  // namespace

ExitCode run_plan(const CommandLine& line, const Console& console) {
  const fs::path& folder = line.output;
  require_free(folder, line.force);
  if (line.plan.planned == "tune") return plan_tune(line, console);
  require_options_of_sweep(line);
  require_division(line.plan);
  CommandLine of_sweep = line;
  if (!line.tune.scenes.empty()) of_sweep.scene = line.tune.scenes.front();
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
  plan.shards = planned_shards(cuts, 0, count_groups(cut));

  prepare_plan_folder(folder);
  Experiment stored = sweep.given;
  stored.scene = store_scene(folder, plan, stored.scene, "scene", line.plan.by_reference);
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
