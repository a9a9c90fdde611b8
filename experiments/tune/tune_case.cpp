#include "experiments/tune/tune_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/lists.h"
#include "experiments/measure/compared_case.h"
#include "experiments/measure/measure_biases.h"
#include "raster/gl/timer.h"

namespace umbrameter {
namespace {

std::vector<SweepAxis> sweep_axes(const std::vector<TuneAxis>& axes) { return mapped(axes, &TuneAxis::axis); }

double value_of(const Statistic& statistic) {
  if (const auto* const* estimate = std::get_if<Estimate*>(&statistic.field)) return (*estimate)->value;
  if (const auto* const* count = std::get_if<std::uint64_t*>(&statistic.field)) return static_cast<double>(**count);
  return *std::get<double*>(statistic.field);
}

// The described object's values at the goal's columns; NaN over no pixels, and for a column that it does not describe.
class GoalReader {
 public:
  GoalReader(Statistics statistics, const TuneGoal& goal) : statistics_(std::move(statistics)) {
    for (const Statistic& each : statistics_) {
      if (each.name == pixels_statistic) pixels_ = &each;
    }
    for (const Column& column : goal.columns) {
      const auto found = std::ranges::find(statistics_, column.name, &Statistic::name);
      columns_.push_back(found == statistics_.end() ? nullptr : &*found);
    }
  }
  CaseValues read() const {
    CaseValues values(columns_.size(), std::numeric_limits<double>::quiet_NaN());
    if (pixels_ != nullptr && value_of(*pixels_) == 0.0) return values;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (columns_[c] != nullptr) values[c] = value_of(*columns_[c]);
    }
    return values;
  }
  bool has(std::size_t column) const { return columns_[column] != nullptr; }
  const Statistics& statistics() const { return statistics_; }

 private:
  Statistics statistics_;
  const Statistic* pixels_ = nullptr;
  std::vector<const Statistic*> columns_;
};

// What is drawn once.
struct Drawn {
  ComparedCase compared;
  ComparedImages images;
};

Drawn draw(const TuneCase& tuned, const Experiment& experiment) {
  Stages& stages = *tuned.stages;
  ComparedCase compared = compare_case(stages, experiment, choose_statistics(stages, experiment, {}, tuned.quantity));
  ComparedImages images = compared.images();
  return {std::move(compared), std::move(images)};
}

// The least of some runs: everything else on the machine can only add to it.
double pass_time(const TuneCase& tuned, const Experiment& experiment) {
  constexpr int runs = 3;
  Stages& stages = *tuned.stages;
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    if (stages.has_engine()) {
      least = std::min(least, 0.001 * stages.engine_time(experiment, tuned.light, tuned.quantity == SweptQuantity::ao));
      continue;
    }
    gl::PassTime time;
    gl::run_timed(&time, [&] {
      if (tuned.quantity == SweptQuantity::ao) {
        stages.draw_ao(experiment);
      } else {
        stages.draw(experiment, tuned.light, false);
      }
    });
    least = std::min(least, time.wall);
  }
  return 1000.0 * least;
}

std::optional<MetricColumn> find_metric(const std::string& name, SweptQuantity quantity) {
  for (const Metric& metric : color_metrics()) {
    for (const MetricColumn& column : columns_of(metric, quantity == SweptQuantity::visibility)) {
      if (column.name == name) return column;
    }
  }
  return {};
}

bool is_of_causes(const std::string& name) {
  VisibilityStatistics statistics;
  const Statistics described = describe(statistics);
  return std::ranges::any_of(described, [&](const Statistic& each) { return each.name == name; });
}

// Image metrics are computed from the images; all else must be described.
void require_columns(const GoalReader& reader, const TuneCase& tuned, const TuneGoal& goal) {
  for (std::size_t c = 0; c < goal.columns.size(); ++c) {
    const std::string& name = goal.columns[c].name;
    if (reader.has(c) || name == pass_time_statistic || find_metric(name, tuned.quantity)) continue;
    const std::string names = joined(reader.statistics(), ", ", &Statistic::name);
    const bool needs_binary = tuned.quantity == SweptQuantity::visibility && is_of_causes(name) &&
                              tuned.stages->is_sampled(tuned.experiment, tuned.light);
    throw Error(ExitCode::usage, tuned.title,
                needs_binary ? fmt::format("'{}' needs a binary reference", name)
                             : fmt::format("this technique and light report no '{}'", name),
                needs_binary ? "set --truth.shadow point" : "choose from: " + names);
  }
}

CaseValues values_of(const Drawn& drawn, const TuneCase& tuned, const TuneGoal& goal, const LeftOut& is_left_out) {
  CellStatistics statistics = drawn.compared.statistics(is_left_out);
  const GoalReader reader(describe(statistics), goal);
  require_columns(reader, tuned, goal);
  CaseValues values = reader.read();
  std::vector<std::size_t> places;
  std::vector<MetricColumn> metrics;
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (reader.has(c) || goal.columns[c].name == pass_time_statistic) continue;
    places.push_back(c);
    metrics.push_back(*find_metric(goal.columns[c].name, tuned.quantity));
  }
  if (metrics.empty()) return values;
  const std::vector<MetricScore> scores = score(metrics, drawn.images, is_left_out);
  for (std::size_t i = 0; i < places.size(); ++i) values[places[i]] = scores[i].score;
  return values;
}

// The most that noise of the reference may have added to a statistic, but for chance.
double noise_in(const CellStatistics& statistics, const std::string& name) {
  const auto* const soft = std::get_if<SoftVisibilityStatistics>(&statistics);
  const auto* const ao = std::get_if<AoStatistics>(&statistics);
  const SampledError* const error = soft != nullptr ? &soft->error : ao != nullptr ? &ao->error : nullptr;
  if (error == nullptr) return 0.0;
  if (name == "mae") return error->mae_noise;
  if (name == "false_blocked" || name == "false_lit") return 0.5 * error->mae_noise;
  return soft != nullptr && name == "penumbra_mae" ? soft->penumbra_noise : 0.0;
}

void set_time(CaseValues& values, const TuneGoal& goal, double time) {
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (goal.columns[c].name == pass_time_statistic) values[c] = time;
  }
}

}  // namespace

std::vector<std::string> titles_of(const std::vector<TuneCase>& cases) { return mapped(cases, &TuneCase::title); }

void require_statistics(const TuneCase& tuned, const TuneGoal& goal) {
  CellStatistics statistics = choose_statistics(*tuned.stages, tuned.experiment, {}, tuned.quantity);
  require_columns(GoalReader(describe(statistics), goal), tuned, goal);
}

void prepare(const TuneCase& tuned) {
  if (tuned.quantity == SweptQuantity::visibility) {
    tuned.stages->truth(tuned.experiment, tuned.light);
  } else if (tuned.quantity == SweptQuantity::ao) {
    tuned.stages->ao_truth(tuned.experiment);
  }
}

Experiment at_point(const TuneCase& tuned, const std::vector<TuneAxis>& axes, const std::vector<Value>& point) {
  return cell_in_metres(*tuned.stages, tuned.experiment, sweep_axes(axes), point);
}

CaseValues measure_case(const TuneCase& tuned, const Experiment& experiment, const TuneGoal& goal) {
  const Drawn drawn = draw(tuned, experiment);
  CaseValues values = values_of(drawn, tuned, goal, {});
  if (goal.measures_time) set_time(values, goal, pass_time(tuned, experiment));
  return values;
}

bool has_exact_bias(const TuneCase& tuned, const std::vector<TuneAxis>& axes, const TuneGoal& goal) {
  if (tuned.quantity != SweptQuantity::visibility) return false;
  VisibilityStatistics statistics;
  const GoalReader reader(describe(statistics), goal);
  for (std::size_t c = 0; c < goal.columns.size(); ++c) {
    if (!reader.has(c)) return false;
  }
  const std::vector<SweepAxis> varied = sweep_axes(axes);
  return is_one_pass(*tuned.stages, tuned.experiment, varied,
                     choose_statistics(*tuned.stages, tuned.experiment, varied, tuned.quantity));
}

std::vector<CaseValues> measure_biases_of(const TuneCase& tuned, const Experiment& experiment, const TuneGoal& goal,
                                          const std::vector<double>& constants) {
  Experiment described = experiment;
  const double slope = to_number(require(describe(described), slope_bias_key).value());
  const auto measured = measure_biases(*tuned.stages, experiment, tuned.light, constants, {slope});
  VisibilityStatistics statistics;
  const GoalReader reader(describe(statistics), goal);
  std::vector<CaseValues> values;
  for (const VisibilityStatistics& each : measured.front()) {
    statistics = each;
    values.push_back(reader.read());
  }
  return values;
}

BlocksOfCase measure_without_blocks(const TuneCase& tuned, const Experiment& experiment, const TuneGoal& goal) {
  BlocksOfCase blocks;
  if (tuned.quantity == SweptQuantity::image) {
    ImageStatistics statistics;
    const GoalReader reader(describe(statistics), goal);
    for (std::size_t c = 0; c < goal.columns.size(); ++c) {
      if (reader.has(c)) return blocks;
    }
  }
  const Drawn drawn = draw(tuned, experiment);
  const double time = goal.measures_time ? pass_time(tuned, experiment) : 0.0;
  const int width = tuned.experiment.view.size.width, height = tuned.experiment.view.size.height;
  const auto block_of = [&](std::size_t i) {
    const int x = static_cast<int>(i % static_cast<std::size_t>(width));
    const int y = static_cast<int>(i / static_cast<std::size_t>(width));
    return y * block_grid / height * block_grid + x * block_grid / width;
  };
  std::vector<bool> is_used(std::size_t{block_grid} * block_grid);
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (std::size_t i = 0; i < pixels; ++i) {
    if (drawn.images.is_counted(i)) is_used[static_cast<std::size_t>(block_of(i))] = true;
  }
  if (std::ranges::count(is_used, true) < 2) return blocks;
  const CellStatistics all = drawn.compared.statistics({});
  blocks.noise = mapped(goal.columns, [&](const Column& column) { return noise_in(all, column.name); });
  for (int block = 0; block < block_grid * block_grid; ++block) {
    if (!is_used[static_cast<std::size_t>(block)]) continue;
    blocks.without.push_back(values_of(drawn, tuned, goal, [&](std::size_t i) { return block_of(i) == block; }));
    blocks.places.push_back({block % block_grid, block / block_grid});
    set_time(blocks.without.back(), goal, time);
  }
  return blocks;
}

}  // namespace umbrameter
