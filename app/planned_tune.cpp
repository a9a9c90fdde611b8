#include "app/planned_tune.h"

#include <algorithm>
#include <array>
#include <memory>

#include "app/plan_folder.h"
#include "core/content_hash.h"
#include "core/interrupt.h"
#include "store/shard_file.h"

namespace umbrameter {
namespace {

constexpr std::array kinds = {"before", "point", "scan"};  // TuneQuery::Kind

TuneQuery query_of(const PlannedPoint& point) {
  const auto place = std::ranges::find(kinds, point.kind) - kinds.begin();
  return {static_cast<TuneQuery::Kind>(place), point.values};
}

SweepAxis counting_axis(const char* key, std::size_t count) {
  SweepAxis axis;
  axis.key = key;
  for (std::size_t i = 0; i < count; ++i) axis.values.emplace_back(static_cast<std::int64_t>(i));
  return axis;
}

// A shard that goes on to the next part of the points needs other references; each cell is an evaluation.
ShardCuts cut_round(const PlannedTuning& tuning, std::size_t points) {
  SweepPlan cells;
  cells.axes = {counting_axis("part", tuning.costs.size()), counting_axis("point", points)};
  cells.strides = {points, 1};
  cells.outer = {0, 1};
  cells.cells = tuning.costs.size() * points;
  SweepCosts costs;
  costs.start_seconds = tuning.start_seconds;
  SweepCosts::Part reference{1.0, false, {{}, {}}};
  SweepCosts::Part evaluation{1.0, true, {{}, {}}};
  for (const PlannedTuning::Cost& cost : tuning.costs) {
    reference.factors[0].push_back(cost.reference);
    evaluation.factors[0].push_back(cost.evaluation);
  }
  costs.parts = {reference, evaluation};
  return cut_into_shards(costs, cells, tuning.shards);
}

}  // namespace

std::vector<Experiment> tuned_experiments(const PlannedFolder& planned) {
  Experiment given = planned.given;
  for (const auto& [name, text] : planned.plan.tuning->options) {
    const std::size_t equals = text.find('=');
    if (name == axis_option) given.axes.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  std::vector<Experiment> experiments;
  for (const std::string& scene : planned.line.tune.scenes) {
    experiments.push_back(given);
    experiments.back().scene = scene;
  }
  return experiments;
}

PointLayout layout_of(const PlannedTuning& tuning, const TuneJob& job) {
  PointLayout layout{tuning.cases, job.goal.columns.size(), std::nullopt};
  for (std::size_t a = 0; tuning.is_exact && a < job.axes.size(); ++a) {
    if (job.axes[a].key() == constant_bias_key) layout.exact = a;
  }
  return layout;
}

TuneGoal planned_goal(const PlannedTuning& tuning, const TuneJob& job) {
  TuneGoal goal = job.goal;
  goal.of_default = tuning.before;
  return goal;
}

std::vector<PlannedCell> planned_cells(const PlannedTuning& tuning, const PointLayout& layout) {
  std::vector<PlannedCell> cells;
  for (const PlannedRound& round : tuning.rounds) {
    for (std::size_t part = 0; part < layout.parts(); ++part) {
      for (const PlannedPoint& point : round.points) cells.push_back({query_of(point), part});
    }
  }
  return cells;
}

SweepPlan cells_as_sweep(std::size_t cells) {
  SweepPlan plan;
  plan.axes = {counting_axis("cell", cells)};
  plan.strides = {1};
  plan.outer = {0};
  plan.cells = cells;
  return plan;
}

ShardCuts add_round(ShardPlan& plan, const PointLayout& layout, const std::vector<TuneQuery>& points) {
  PlannedTuning& tuning = *plan.tuning;
  PlannedRound& round = tuning.rounds.emplace_back();
  round.first_shard = plan.shards.size();
  for (const TuneQuery& query : points) {
    round.points.push_back({kinds[static_cast<std::size_t>(query.kind)], query.values});
  }
  const ShardCuts cuts = cut_round(tuning, points.size());
  const std::size_t cells = layout.parts() * points.size();
  const std::vector<PlannedShard> shards = planned_shards(cuts, plan.cells, cells);
  plan.shards.insert(plan.shards.end(), shards.begin(), shards.end());
  plan.cells += cells;
  return cuts;
}

Identity portable_identity(TuneRun& run) {
  Identity identity = run.identity();
  for (auto& [name, value] : identity) {
    if (!name.starts_with("scene")) continue;
    name.insert(0, "content of ");
    value = ContentHash().add(value).hex();
  }
  return identity;
}

ShardMeasurer load_tune_measurer(const PlannedFolder& planned, const Console& console) {
  struct Loaded {
    explicit Loaded(const PlannedFolder& of) : run(of.line, tuned_experiments(of)) {}
    TuneRun run;
    std::vector<std::string> notes{};
    std::optional<PointMeasurer> points{};
    TuneGoal goal{};
    std::vector<PlannedCell> cells{};
  };
  const auto loaded = std::make_shared<Loaded>(planned);
  TuneRun& run = loaded->run;
  run.load(console);
  require_planned(planned.folder, planned.plan, portable_identity(run));
  loaded->notes = run.notes();
  loaded->points.emplace(run.job.axes, run.cases, run.job.goal);
  loaded->goal = planned_goal(*planned.plan.tuning, run.job);
  loaded->cells = planned_cells(*planned.plan.tuning, loaded->points->layout());

  ShardMeasurer measurer;
  measurer.measured_by = measuring_identity(run.stages.front());
  measurer.maker = maker_of(run.stages.front());
  measurer.notes = [loaded] {
    std::vector<std::string> more;
    for (const std::string& text : loaded->run.notes()) {
      if (std::ranges::find(loaded->notes, text) == loaded->notes.end()) more.push_back(text);
    }
    return more;
  };
  measurer.report_tracing = [loaded](const Progress& to) {
    for (Stages& stages : loaded->run.stages) stages.report_tracing(to);
  };
  measurer.measure = [loaded](const PlannedShard& shard, std::string& rows, const auto& report) {
    for (std::size_t i = 0; i < shard.groups; ++i) {
      throw_if_interrupted("the shard starts over when it is run again");
      const PlannedCell& cell = loaded->cells[shard.first_group + i];
      const std::vector<double> numbers = loaded->points->measure_part(cell.query, cell.part, loaded->goal);
      append_values(rows, std::vector<Value>(numbers.begin(), numbers.end()));
      report(i + 1, static_cast<double>(i + 1) / static_cast<double>(shard.groups));
    }
  };
  return measurer;
}

}  // namespace umbrameter
