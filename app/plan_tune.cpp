#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "app/plan_folder.h"
#include "app/planned_tune.h"
#include "app/print_json.h"
#include "core/standard_streams.h"
#include "experiments/settings/sweep_costs.h"
#include "experiments/stages/work_clock.h"
#include "present/run_output.h"
#include "reports/files/text_layout.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

void require_options_of_tune(const CommandLine& line) {
  if (line.plan.shards == 0) {
    throw Error(ExitCode::usage, "plan tune", "nothing says how many shards a round has",
                line.plan.cells_per_shard > 0 || line.plan.minutes_per_shard > 0.0
                    ? "add --shards N; the other two are for sweeps"
                    : "add --shards N");
  }
  if (line.tune.minutes > 0.0) {
    throw Error(ExitCode::usage, "--minutes", "the time of a divided tuning is not limited", "limit its --evaluations");
  }
}

// What the parts of a point take, at the first value of each axis. Those that there is no time for take as long as the
// others on average. The first evaluation of a process takes longer; that is part of its start.
void measure_costs(PlannedTuning& tuning, TuneRun& run, const PointMeasurer& points) {
  const PointLayout& layout = points.layout();
  const TuneGoal goal = not_relative(run.job.goal);
  TuneQuery query;
  for (const TuneAxis& axis : run.job.axes) query.values.push_back(axis.axis.values.front());
  const WorkClock work = run.cases.front().stages->work_clock();
  const double begin = clock_seconds();
  const double work_begin = work();
  const auto work_of = [&](const auto& task) {
    const double start = work();
    task();
    return work() - start;
  };
  const auto evaluate = [&](std::size_t part) { points.measure_part(query, part, goal); };
  PlannedTuning::Cost sum;
  double start = 0.0;
  for (std::size_t part = 0; part < layout.parts() && (part == 0 || work() - work_begin < cost_budget); ++part) {
    PlannedTuning::Cost cost;
    cost.reference = work_of([&] {
      for (std::size_t i = 0; i < run.cases.size(); ++i) {
        if (layout.exact || i == part) prepare(run.cases[i]);
      }
    });
    cost.evaluation = work_of([&] { evaluate(part); });
    if (part == 0) {
      const double again = work_of([&] { evaluate(part); });
      start = std::max(0.0, cost.evaluation - again);
      cost.evaluation = again;
    }
    tuning.costs.push_back(cost);
    sum.reference += cost.reference;
    sum.evaluation += cost.evaluation;
  }
  const auto measured = static_cast<double>(tuning.costs.size());
  tuning.costs.resize(layout.parts(), {sum.reference / measured, sum.evaluation / measured});
  const double scale = (clock_seconds() - begin) / (work() - work_begin);
  tuning.start_seconds += scale * start;
  for (PlannedTuning::Cost& cost : tuning.costs) cost = {scale * cost.reference, scale * cost.evaluation};
}

// The options with the scenes as the plan calls them; each file is stored once.
TuneOptions store_scenes(const CommandLine& line, const TuneJob& job, ShardPlan& plan) {
  std::map<std::string, std::string> stored;
  const auto store = [&](const std::string& scene) {
    const std::string source = fs::is_regular_file(scene) ? fs::absolute(scene).lexically_normal().string() : scene;
    const auto found = stored.find(source);
    if (found != stored.end()) return found->second;
    const fs::path subfolder = fs::path("scene") / std::to_string(plan.scene_files.size() + 1);
    return stored[source] = store_scene(line.output, plan, source, subfolder, line.plan.by_reference);
  };
  TuneOptions options = line.tune;
  options.scenes.clear();
  for (const Experiment& experiment : job.experiments) options.scenes.push_back(store(experiment.scene));
  for (std::string& assignment : options.held_out) {
    if (!assignment.starts_with(held_out_scene)) continue;
    assignment = std::string(held_out_scene) + store(assignment.substr(held_out_scene.size()));
  }
  return options;
}

void show_plan(const Console& console, const fs::path& folder, const ShardPlan& plan, const ShardCuts& cuts) {
  const PlannedTuning& tuning = *plan.tuning;
  const std::size_t points = tuning.rounds.back().points.size();
  const double longest = std::ranges::max(cuts.seconds);
  print_json(console, {{"round", 1},
                       {"points", points},
                       {"cases", tuning.cases},
                       {"shards", plan.shards.size()},
                       {"longest_seconds", longest}});
  print_line(console,
             fmt::format("round 1: {} points of {} case{} in {} shards of at most about {}", points, tuning.cases,
                         tuning.cases == 1 ? "" : "s", plan.shards.size(), time_text(std::ceil(longest))));
  add_line(console, fmt::format("next: {} with K from 0 to {}", command_of(folder, "K"), plan.shards.size() - 1));
  add_line(console, "then: umbrameter merge " + shell_word(folder) +
                        " -o DIR, which plans the next round until the search has ended");
}

}  // namespace

ExitCode plan_tune(const CommandLine& line, const Console& console) {
  require_options_of_tune(line);
  const std::vector<Experiment> given = tuned_experiments(line);
  TuneRun run(line, given);
  const double start = clock_seconds();
  run.load(console);
  ShardPlan plan;
  plan.presets = line.presets;
  plan.identity = portable_identity(run);
  PlannedTuning& tuning = plan.tuning.emplace();
  tuning.start_seconds = clock_seconds() - start;
  for (const TuneCase& each : run.cases) each.stages->report_tracing([](double) {});
  const PointMeasurer points(run.job.axes, run.cases, run.job.goal);
  measure_costs(tuning, run, points);

  const PointLayout& layout = points.layout();
  tuning.cases = layout.cases;
  tuning.is_exact = layout.exact.has_value();
  tuning.shards = line.plan.shards;
  const std::size_t by_shards = std::max<std::size_t>(1, line.plan.shards / layout.parts());
  tuning.points = line.plan.points_per_round > 0 ? line.plan.points_per_round : by_shards;
  plan.kinds.assign(layout.numbers(), ValueKind::real);
  const ShardCuts cuts = add_round(plan, layout, next_round(run.search_input(layout.exact), {}, tuning.points).points);

  prepare_plan_folder(line.output);
  tuning.options = pairs_of(store_scenes(line, run.job, plan));
  Experiment stored = given.front();
  stored.scene = tune_options(tuning.options).scenes.front();
  for (const auto& [key, text] : std::exchange(stored.axes, {})) {
    tuning.options.emplace_back(axis_option, key + "=" + text);
  }
  write_plan(line.output, plan, experiment_text(stored));
  if (!line.plan.commands) {
    show_plan(console, line.output, plan, cuts);
    return ExitCode::ok;
  }
  for (std::size_t i = 0; i < plan.shards.size(); ++i) {
    write_to(stdout, command_of(line.output, std::to_string(i)) + "\n");
  }
  return ExitCode::ok;
}

}  // namespace umbrameter
