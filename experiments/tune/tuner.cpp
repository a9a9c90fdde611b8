#include "experiments/tune/tuner.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/digits.h"
#include "core/interrupt.h"
#include "core/lists.h"
#include "experiments/measure/measure_biases.h"
#include "experiments/sweep/axis_effects.h"
#include "experiments/tune/tune_points.h"

namespace umbrameter {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t max_curve_points = 200;
constexpr double least_difference = 0.05;  // between a runner-up and the best, as a share of an axis

// One case in which a large bias detaches shadows is enough.
BiasEvidence evidence_of(const TuneInput& in, const std::vector<Value>& values) {
  BiasEvidence all;
  all.has_floor = all.is_on_others = false;
  std::uint64_t blocked = 0;
  for (const TuneCase& each : in.cases) {
    const BiasEvidence of_case = measure_bias_evidence(*each.stages, at_point(each, in.axes, values), each.light);
    all.pixels += of_case.pixels;
    all.lit += of_case.lit;
    all.blocked += of_case.has_receiver() ? of_case.blocked : 0;
    blocked += of_case.blocked;
    all.has_floor = all.has_floor || of_case.has_floor;
    all.is_on_others = all.is_on_others || of_case.is_on_others;
  }
  if (!all.has_receiver()) all.blocked = blocked;
  return all;
}

// Those of which the cost is a share, of which a few are chance; 0 of other costs.
std::uint64_t pixels_of_cost(const TuneResult& result, const TuneInput& in) {
  const bool is_share = result.goal.text == error_statistic && !result.goal.is_worst_case && !result.goal.is_relative;
  std::uint64_t pixels = 0;
  for (const TuneCase& each : in.cases) {
    if (!is_share || each.quantity != SweptQuantity::visibility) return 0;
    const auto counted = each.stages->counted(at_point(each, in.axes, result.best.values), each.light);
    pixels += counted->totals[static_cast<std::size_t>(PixelExclusion::none)];
  }
  return pixels;
}

// The slope-scaled bias and, of the cases, the most acne of each cell.
void add_acne(std::vector<BiasCell>& cells, const TuneInput& in, const std::vector<Value>& values) {
  const std::vector<double> constants = mapped(cells, &BiasCell::constant);
  for (const TuneCase& each : in.cases) {
    throw_if_interrupted();
    const Experiment experiment = at_point(each, in.axes, values);
    const auto measured =
        measure_biases(*each.stages, experiment, each.light, constants, {experiment.shadow.bias.slope});
    for (std::size_t i = 0; i < cells.size(); ++i) {
      cells[i].slope = experiment.shadow.bias.slope;
      cells[i].acne = std::max(cells[i].acne, measured.front()[i].acne);
    }
  }
}

// The recommended bias, rounded up to three digits if that one is as good: what is printed is then the very bias whose
// error is printed.
void round_recommended(TuneResult& result, TunePoint& point, const TuneInput& in, const PointMeasurer& measurer) {
  BiasPlateau& plateau = *result.plateau;
  const double exact = plateau.recommended.constant;
  const double step = step_of_last_digit(exact, 3);
  if (exact == 0.0 || !in.axes[*measurer.layout().exact].is_continuous) return;
  BiasCell cell{std::stod(fmt::format("{:.3g}", std::ceil(exact / step - 1e-9) * step)), 0.0, 0.0};
  if (cell.constant == exact || cell.constant > plateau.last.constant) return;
  std::vector<Value> values = result.best.values;
  values[*measurer.layout().exact] = cell.constant;
  const TunePoint rounded = scored(measurer.measure({TuneQuery::Kind::scan, values}, result.goal), result.goal);
  std::vector<BiasCell> cells = {cell};
  add_acne(cells, in, values);
  cells[0].mae = rounded.score.cost;
  const bool is_as_good =
      rounded.score.is_kept() && cells[0].mae <= plateau.limit && cells[0].acne <= little_acne_share;
  if (!is_as_good) return;
  plateau.recommended = cells[0];
  point = rounded;
}

// `all`: the best point at every constant bias. `pixels` as plateau_of() takes them.
void find_plateau(TuneResult& result, const TuneInput& in, const PointMeasurer& measurer,
                  const std::vector<TunePoint>& all, std::uint64_t pixels) {
  const std::vector<double>& constants = measurer.constants();
  const std::size_t step = std::max<std::size_t>(1, all.size() / max_curve_points);
  for (std::size_t i = 0; i < all.size(); i += step) result.curve.push_back(all[i]);
  if (!result.best.score.is_kept()) return;
  std::vector<BiasCell> cells;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_kept = all[i].score.is_kept() && !std::isnan(all[i].score.cost);
    cells.push_back({constants[i], 0.0, is_kept ? all[i].score.cost : std::numeric_limits<double>::infinity()});
  }
  add_acne(cells, in, result.best.values);
  std::ranges::sort(cells, [](const BiasCell& a, const BiasCell& b) { return a.constant < b.constant; });
  result.evidence = evidence_of(in, result.best.values);
  result.plateau = plateau_of(cells, {}, pixels);
  result.withheld = reason_against_on_axis(*result.plateau, result.evidence);
  if (result.withheld || !result.plateau->has_little_acne()) return;
  const auto recommended = std::ranges::find(constants, result.plateau->recommended.constant);
  TunePoint point = all.at(static_cast<std::size_t>(recommended - constants.begin()));
  round_recommended(result, point, in, measurer);
  if (point.values != result.best.values) result.recommended = point;
}

bool differ(const std::vector<TuneAxis>& axes, const std::vector<Value>& a, const std::vector<Value>& b) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].is_word() ? a[i] != b[i]
                          : std::abs(position_of(axes[i], a[i]) - position_of(axes[i], b[i])) >= least_difference) {
      return true;
    }
  }
  return false;
}

// Takes the best of these points as runner-up if it is better than what is known.
void find_runner_up(TuneResult& result, const std::vector<TuneAxis>& axes, const std::vector<TunePoint>& points) {
  for (const TunePoint& point : points) {
    if (result.runner_up && !is_better(point.score, result.runner_up->score)) continue;
    // Points along the axes are measured after the search, which may have missed a better one.
    if (is_better(point.score, result.best.score) || !differ(axes, point.values, result.best.values)) continue;
    result.runner_up = point;
  }
}

std::vector<std::string> unread_at(const TunePoint& point, const TuneInput& in) {
  const TuneCase& first = in.cases.front();
  const Experiment experiment = at_point(first, in.axes, point.values);
  std::vector<std::string> unread;
  for (const TuneAxis& axis : in.axes) {
    if (!is_read(first.quantity, experiment, axis.key())) unread.push_back(axis.key());
  }
  return unread;
}

void find_best_of_words(TuneResult& result, const TuneInput& in) {
  const std::vector<TuneAxis>& axes = in.axes;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    if (!axes[a].is_word()) continue;
    for (const Value& word : axes[a].axis.values) {
      const TunePoint* best = nullptr;
      const auto take = [&](const TunePoint& point) {
        if (point.values[a] == word && (best == nullptr || is_better(point.score, best->score))) best = &point;
      };
      std::ranges::for_each(result.points, take);
      // Of the best word, the best point is the search's, although a scan may have found one that is a little better.
      if (result.best.values[a] != word) {
        for (const AxisScan& scan : result.scans) std::ranges::for_each(scan.points, take);
      }
      if (best != nullptr) result.of_words.push_back({a, *best, unread_at(*best, in)});
    }
  }
}

}  // namespace

TuneResult tune(const TuneInput& input, TuneJournal& journal, const TuneProgress& progress) {
  const PointMeasurer measurer(input.axes, input.cases, input.goal);
  const std::optional<std::size_t> exact = measurer.layout().exact;
  const Clock::time_point start = Clock::now();
  bool has_point = false;
  const AskPoint ask = [&](const TuneQuery& query, const TuneGoal& goal) {
    const std::string key = key_of(query, exact);
    const bool is_point = query.kind == TuneQuery::Kind::point;
    if (const TuneRecord* known = journal.find(key)) {
      has_point = has_point || is_point;
      return scored(*known, goal);
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (is_point && has_point && input.budget.minutes > 0.0 && seconds > 60.0 * input.budget.minutes) {
      throw SearchEnd{fmt::format("{:g} minutes", input.budget.minutes)};
    }
    has_point = has_point || is_point;
    return scored(journal.add(key, measurer.measure(query, goal)), goal);
  };
  const SearchInput search{input.axes, input.goal, input.given, input.budget.evaluations, exact};
  TuneResult result = search_points(search, ask, progress);
  scan_axes(search, result, ask);
  const std::uint64_t pixels = pixels_of_cost(result, input);
  result.limit = limit_of_plateau(result.best.score.cost, pixels);
  find_runner_up(result, input.axes, result.points);
  if (exact) {
    const std::vector<TunePoint> all = measurer.measure_curve(result.best.values, result.goal);
    find_plateau(result, input, measurer, all, pixels);
    find_runner_up(result, input.axes, all);
    result.scans[*exact].points = result.curve;
  }
  find_best_of_words(result, input);
  for (const AxisScan& scan : result.scans) find_runner_up(result, input.axes, scan.points);
  return result;
}

}  // namespace umbrameter
