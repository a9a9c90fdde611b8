#include <fmt/format.h>

#include <algorithm>

#include "app/planned_tune.h"
#include "core/lists.h"
#include "present/run_output.h"
#include "reports/files/output.h"
#include "store/shard_file.h"

namespace umbrameter {
namespace {

// The points whose cells are all there.
KnownPoints points_of(const ScratchRows& rows, const std::vector<PlannedCell>& cells, const PointLayout& layout) {
  std::map<std::string, std::pair<TuneQuery, std::vector<std::vector<double>>>> parts;
  rows.read([&](std::size_t cell, std::span<const Value> values) {
    const auto& [query, part] = cells[cell];
    auto& [of_query, numbers] = parts[key_of(query, layout.exact)];
    of_query = query;
    numbers.emplace_back();
    for (const Value& value : values.subspan(1)) numbers.back().push_back(to_number(value));  // after the cell's number
  });
  KnownPoints points;
  for (const auto& [key, point] : parts) points[key] = join_parts(layout, point.first, point.second);
  return points;
}

// Writes the next round and says what to run.
[[noreturn]] void plan_next(const PlannedFolder& planned, const TuneRun& run, const NextRound& next,
                            const KnownPoints& points, const Console& console) {
  ShardPlan plan = planned.plan;
  PlannedTuning& tuning = *plan.tuning;
  if (const auto before = points.find("before"); before != points.end()) {
    tuning.before = relative_to(run.job.goal, before->second.cases).of_default;
  }
  const std::size_t first = plan.shards.size();
  const std::size_t rounds = tuning.rounds.size();
  add_round(plan, layout_of(tuning, run.job), next.points);
  write_plan(planned.folder, plan, text_of_file(planned.folder / "experiment.toml").value());
  std::vector<std::size_t> shards;
  for (std::size_t shard = first; shard < plan.shards.size(); ++shard) shards.push_back(shard);
  // One more for the points around the best one.
  const bool is_last = next.points.front().kind == TuneQuery::Kind::scan;
  const std::size_t more =
      is_last ? 0 : divide_up(next.limit - std::min(next.limit, next.searched), next.points.size());
  print_line(console,
             fmt::format("round {} of about {}: {} in {}; {} of at most {} evaluations are "
                         "done, which needed {} of the {} measured points",
                         rounds + 1, rounds + more + 1, count_text(next.points.size(), "point"),
                         count_text(shards.size(), "shard"), next.searched, next.limit, next.used, points.size()));
  show_shards(console, planned, shards, {});
  throw Error(ExitCode::partial, planned.folder.string(), "the search has not ended",
              fmt::format("run the shards of round {} and merge again", rounds + 1));
}

}  // namespace

ExitCode merge_tune(const PlannedFolder& planned, const CommandLine& line, const Console& console) {
  if (line.plan.partial) {
    throw Error(ExitCode::usage, "--partial", "a tuning has no partial result", "run its shards and merge again");
  }
  const PlannedTuning& tuning = *planned.plan.tuning;
  TuneRun run(planned.line, tuned_experiments(planned));
  const PointLayout layout = layout_of(tuning, run.job);
  RunFolder folder(line.output, plan_of(run), line.force);
  MeasuredPoints measured;
  CollectedShards collected;
  {
    const SweepPlan cells = cells_as_sweep(planned.plan.cells);
    ScratchRows rows(folder.path(), cells, planned.plan.kinds);
    collected = collect_shards(planned.folder, planned.plan, rows);
    if (!collected.missing.empty()) {
      show_shards(console, planned, collected.missing, collected.problems);
      throw missing_shards(planned, collected, "run them and merge");
    }
    measured.points = points_of(rows, planned_cells(tuning, layout), layout);
  }
  for (const std::string& problem : collected.problems) note(console, problem);
  const NextRound next = next_round(run.search_input(layout.exact), measured.points, tuning.points);
  if (!next.points.empty()) plan_next(planned, run, next, measured.points, console);

  run.load(console);
  require_planned(planned.folder, planned.plan, portable_identity(run));
  note(console, fmt::format("{} of {} measured points were needed, in {}", next.used, measured.points.size(),
                            count_text(tuning.rounds.size(), "round")));
  measured.notes = collected.notes;
  if (const std::string text = makers_text("points", collected.makers); !text.empty()) measured.notes.push_back(text);
  return write_tune(run, folder, measured, console);
}

}  // namespace umbrameter
