#include "experiments/tune/tuner.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>

#include "core/error.h"
#include "core/interrupt.h"
#include "experiments/measure/measure_biases.h"
#include "experiments/tune/minimize.h"

namespace umbrameter {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t max_curve_points = 200;
constexpr double least_difference = 0.05;  // between a runner-up and the best, as a share of an axis

// The search ends: the budget is spent.
struct BudgetSpent {};

// Both hold every value of the evenly spaced axes of 1,000 and of 1,001 values, so that the least cost on these is
// never missed.
std::vector<double> dense_values(const Parameters& parameters, const TuneAxis& axis) {
  std::vector<double> values;
  if (!axis.is_continuous) {
    for (const Value& value : axis.axis.values) values.push_back(to_number(value));
    return values;
  }
  const std::string ends = axis.is_logarithmic ? axis.axis.text.substr(0, axis.axis.text.size() - 4) : axis.axis.text;
  for (const int count : {8 * 999 + 1, 8 * 1000 + 1}) {
    const std::string text = fmt::format("{}:{}{}", ends, count, axis.is_logarithmic ? ":log" : "");
    for (const Value& value : parse_axis(parameters, axis.key(), text).values) values.push_back(to_number(value));
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

class Tuner {
 public:
  Tuner(const TuneInput& input, TuneJournal& journal, const TuneProgress& progress)
      : in_(input), goal_(input.goal), journal_(journal), progress_(progress), start_(Clock::now()) {
    for (std::size_t a = 0; a < in_.axes.size(); ++a) {
      if (in_.axes[a].key() == constant_bias_key && is_exact()) {
        exact_ = a;
      } else {
        (in_.axes[a].is_word() ? words_ : numbers_).push_back(a);
      }
    }
    limit_ = in_.budget.evaluations;
    if (limit_ == 0) {
      limit_ = default_evaluations(words_.size() + numbers_.size(), numbers_.size(), combinations_of_words());
    }
    if (exact_) {
      Experiment experiment;
      constants_ = dense_values(describe(experiment), in_.axes[*exact_]);
    }
  }

  TuneResult run() {
    result_.is_exact = exact_.has_value();
    result_.before = measure_before();
    result_.goal = goal_ = relative_to(goal_, result_.before.cases);
    result_.before.score = score_of(goal_, result_.before.values, result_.before.cases);
    try {
      search();
    } catch (const BudgetSpent&) {
      // What was found until now is the result.
    }
    if (result_.points.empty()) throw Error(ExitCode::usage, "tune", "the budget allows no evaluation");
    result_.evaluations = result_.points.size();
    result_.best = *std::min_element(result_.points.begin(), result_.points.end(),
                                     [](const auto& a, const auto& b) { return is_better(a.score, b.score); });
    if (std::isnan(result_.best.score.cost)) {
      throw Error(ExitCode::usage, "tune", "no case counts a pixel, so that nothing can be minimised",
                  "choose another camera or light");
    }
    if (exact_) find_plateau();
    find_runner_up();
    find_best_of_words();
    for (std::size_t a = 0; a < in_.axes.size(); ++a) scan(a);
    return std::move(result_);
  }

 private:
  bool is_exact() const {
    return std::all_of(in_.cases.begin(), in_.cases.end(),
                       [&](const TuneCase& each) { return has_exact_bias(each, in_.axes, goal_); });
  }

  static std::string key_of(const char* kind, const std::vector<Value>& values, std::optional<std::size_t> left_out) {
    std::string key = kind;
    for (std::size_t a = 0; a < values.size(); ++a) {
      key += fmt::format("|{}", a == left_out ? "*" : to_string(values[a]));
    }
    return key;
  }

  TunePoint scored(const TuneRecord& record) const {
    return {record.point, record.cases, score_of(goal_, record.point, record.cases)};
  }

  // Of every case at one point.
  TunePoint measure_at(const char* kind, const std::vector<Value>& values) {
    const std::string key = key_of(kind, values, std::nullopt);
    if (const TuneRecord* known = journal_.find(key)) return scored(*known);
    TuneRecord record{values, {}};
    for (const TuneCase& each : in_.cases) {
      throw_if_interrupted();
      record.cases.push_back(measure_case(each, at_point(each, in_.axes, values), goal_));
    }
    return scored(journal_.add(key, std::move(record)));
  }

  // The experiments as given; their values may lie outside the axes.
  TunePoint measure_before() {
    if (const TuneRecord* known = journal_.find("before")) return scored(*known);
    TuneRecord record{in_.given, {}};
    for (const TuneCase& each : in_.cases) {
      throw_if_interrupted();
      record.cases.push_back(measure_case(each, each.experiment, goal_));
    }
    return scored(journal_.add("before", std::move(record)));
  }

  // At every constant bias, in one pass per case.
  std::vector<TunePoint> measure_curve(const std::vector<Value>& values) {
    std::vector<TunePoint> curve(constants_.size());
    for (std::size_t i = 0; i < curve.size(); ++i) {
      curve[i].values = values;
      curve[i].values[*exact_] = constants_[i];
    }
    for (const TuneCase& each : in_.cases) {
      throw_if_interrupted();
      const Experiment experiment = at_point(each, in_.axes, curve.front().values);
      std::vector<CaseValues> measured = measure_biases_of(each, experiment, goal_, constants_);
      for (std::size_t i = 0; i < curve.size(); ++i) curve[i].cases.push_back(std::move(measured[i]));
    }
    for (TunePoint& point : curve) point.score = score_of(goal_, point.values, point.cases);
    return curve;
  }

  // The middle of the first run of equally good points: the farthest from what is worse on either side.
  static const TunePoint& best_of(const std::vector<TunePoint>& curve) {
    std::size_t first = 0;
    for (std::size_t i = 1; i < curve.size(); ++i) {
      if (is_better(curve[i].score, curve[first].score)) first = i;
    }
    std::size_t last = first;
    while (last + 1 < curve.size() && !is_better(curve[first].score, curve[last + 1].score)) ++last;
    return curve[first + (last - first) / 2];
  }

  // Evaluates a point once; with an exact bias, finds the best bias for the other values.
  TuneScore evaluate(const std::vector<Value>& values) {
    const std::string key = key_of("point", values, exact_);
    if (const auto seen = seen_.find(key); seen != seen_.end()) return result_.points[seen->second].score;
    if (result_.points.size() >= limit_) throw BudgetSpent{};
    const TuneRecord* known = journal_.find(key);
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    if (known == nullptr && in_.budget.minutes > 0.0 && seconds > 60.0 * in_.budget.minutes && !seen_.empty()) {
      result_.stopped_by = fmt::format("{:g} minutes", in_.budget.minutes);
      throw BudgetSpent{};
    }
    TunePoint point;
    if (known != nullptr) {
      point = scored(*known);
    } else if (exact_) {
      point = best_of(measure_curve(values));
      journal_.add(key, {point.values, point.cases});
    } else {
      point = measure_at("point", values);
    }
    if (!best_ || is_better(point.score, *best_)) best_ = point.score;
    seen_[key] = result_.points.size();
    result_.points.push_back(std::move(point));
    if (progress_) progress_(result_.points.size(), limit_, *best_);
    return result_.points.back().score;
  }

  std::vector<Value> first_values() const {
    std::vector<Value> values;
    for (const TuneAxis& axis : in_.axes) values.push_back(axis.axis.values.front());
    return values;
  }

  void search() {
    std::size_t combinations = 1;
    bool is_finite = true;
    for (const std::vector<std::size_t>* axes : {&words_, &numbers_}) {
      for (const std::size_t a : *axes) {
        is_finite = is_finite && !in_.axes[a].is_continuous;
        combinations = std::min<std::size_t>(combinations * in_.axes[a].count(), limit_ + 1);
      }
    }
    if (numbers_.empty() && words_.empty()) {
      result_.method = "every value of the constant bias in one pass";
      evaluate(first_values());
    } else if (is_finite && combinations <= limit_) {
      result_.method = fmt::format("all {} combinations", combinations);
      std::vector<std::size_t> all = words_;
      all.insert(all.end(), numbers_.begin(), numbers_.end());
      for_each_combination(all, first_values(), [&](const std::vector<Value>& values) { evaluate(values); });
    } else {
      search_numbers();
    }
    if (exact_ && !(numbers_.empty() && words_.empty())) {
      result_.method += "; at each point every value of the constant bias in one pass";
    }
  }

  void for_each_combination(const std::vector<std::size_t>& axes, std::vector<Value> values,
                            const std::function<void(const std::vector<Value>&)>& take, std::size_t depth = 0) {
    if (depth == axes.size()) return take(values);
    for (const Value& value : in_.axes[axes[depth]].axis.values) {
      values[axes[depth]] = value;
      for_each_combination(axes, values, take, depth + 1);
    }
  }

  std::vector<double> positions_of(const std::vector<Value>& values) const {
    std::vector<double> positions;
    for (const std::size_t a : numbers_) {
      const double position = position_of(in_.axes[a], values[a]);
      if (!(position >= 0.0 && position <= 1.0)) return {};
      positions.push_back(position);
    }
    return positions;
  }

  std::vector<Value> values_from(std::vector<Value> values, const std::vector<double>& positions) const {
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      values[numbers_[i]] = value_at(in_.axes[numbers_[i]], positions[i]);
    }
    return values;
  }

  std::size_t combinations_of_words() const {
    std::size_t combinations = 1;
    for (const std::size_t a : words_) combinations *= in_.axes[a].count();
    return combinations;
  }

  // The best of the points from `first` on.
  const TunePoint& best_since(std::size_t first) const {
    return *std::min_element(result_.points.begin() + static_cast<std::ptrdiff_t>(first), result_.points.end(),
                             [](const TunePoint& a, const TunePoint& b) { return is_better(a.score, b.score); });
  }

  // Minimises over the numbers from the position of `start`, with the words of `words`, until there are `most` points.
  void search_from(const std::vector<Value>& words, const std::vector<Value>& start, bool is_global, std::size_t most) {
    struct Share {};
    const auto at = [&](const std::vector<double>& position) {
      if (result_.points.size() >= most) throw Share{};
      return to_number(evaluate(values_from(words, position)));
    };
    // Rounded values repeat; a repeated point costs nothing, so that the optimiser may ask more often.
    const std::size_t calls = 20 * limit_;
    try {
      minimize({numbers_.size(), is_global ? calls : 0, is_global ? 0 : calls, positions_of(start)}, at);
    } catch (const Share&) {
      // The next search has its turn.
    }
  }

  // In each combination of words the global search and then the local one, with equal shares, so that no word wins
  // because it was searched better; then the local one from the best point of all.
  void search_numbers() {
    const std::size_t combinations = combinations_of_words();
    result_.method = fmt::format("{}DIRECT-L, then subplex", words_.empty() ? "" : "for each combination of words ");
    const std::size_t share = combinations == 1 ? limit_ : limit_ * 8 / 10 / combinations;
    const std::size_t global = std::max<std::size_t>(2 * numbers_.size() + 1, share * 6 / 10);
    for_each_combination(words_, first_values(), [&](const std::vector<Value>& words) {
      const std::size_t before = result_.points.size();
      search_from(words, in_.given, true, before + global);
      if (combinations > 1) search_from(words, best_since(before).values, false, before + std::max(share, global + 1));
    });
    const std::vector<Value> start = best_since(0).values;
    search_from(start, start, false, limit_ + 1);
  }

  void find_plateau() {
    const std::vector<TunePoint> all = measure_curve(result_.best.values);
    const std::size_t step = std::max<std::size_t>(1, all.size() / max_curve_points);
    for (std::size_t i = 0; i < all.size(); i += step) result_.curve.push_back(all[i]);
    if (!result_.best.score.is_kept()) return;
    std::vector<BiasCell> cells;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool is_kept = all[i].score.is_kept() && !std::isnan(all[i].score.cost);
      cells.push_back({constants_[i], 0.0, is_kept ? all[i].score.cost : std::numeric_limits<double>::infinity()});
    }
    for (const TuneCase& each : in_.cases) {
      throw_if_interrupted();
      const Experiment experiment = at_point(each, in_.axes, result_.best.values);
      const auto measured =
          measure_biases(*each.stages, experiment, each.light, constants_, {experiment.shadow.bias.slope});
      for (std::size_t i = 0; i < cells.size(); ++i) {
        cells[i].slope = experiment.shadow.bias.slope;
        cells[i].acne = std::max(cells[i].acne, measured.front()[i].acne);
      }
    }
    std::sort(cells.begin(), cells.end(), [](const BiasCell& a, const BiasCell& b) { return a.constant < b.constant; });
    result_.plateau = plateau_of(cells);
  }

  bool differs(const std::vector<Value>& a, const std::vector<Value>& b) const {
    for (std::size_t i = 0; i < in_.axes.size(); ++i) {
      if (in_.axes[i].is_word()
              ? a[i] != b[i]
              : std::abs(position_of(in_.axes[i], a[i]) - position_of(in_.axes[i], b[i])) >= least_difference) {
        return true;
      }
    }
    return false;
  }

  void find_runner_up() {
    for (const std::vector<TunePoint>* points : {&result_.points, &result_.curve}) {
      for (const TunePoint& point : *points) {
        if (!differs(point.values, result_.best.values)) continue;
        if (!result_.runner_up || is_better(point.score, result_.runner_up->score)) result_.runner_up = point;
      }
    }
  }

  void find_best_of_words() {
    for (const std::size_t a : words_) {
      for (const Value& word : in_.axes[a].axis.values) {
        const TunePoint* best = nullptr;
        for (const TunePoint& point : result_.points) {
          if (point.values[a] == word && (best == nullptr || is_better(point.score, best->score))) best = &point;
        }
        if (best != nullptr) result_.of_words.push_back({a, *best});
      }
    }
  }

  void scan(std::size_t a) {
    AxisScan scan{a, {}};
    const TuneAxis& axis = in_.axes[a];
    if (a == exact_) {
      scan.points = result_.curve;
    } else {
      std::vector<Value> values;
      const double best = position_of(axis, result_.best.values[a]);
      if (axis.is_word() || (!axis.is_continuous && axis.count() <= 8)) {
        values = axis.axis.values;
      } else {
        std::set<double> positions = {best};
        for (const double step : {-0.4, -0.15, -0.05, 0.05, 0.15, 0.4}) {
          positions.insert(std::clamp(best + step, 0.0, 1.0));
        }
        for (const double position : positions) values.push_back(value_at(axis, position));
        values.erase(std::unique(values.begin(), values.end()), values.end());
      }
      for (const Value& value : values) {
        std::vector<Value> point = result_.best.values;
        point[a] = value;
        scan.points.push_back(value == result_.best.values[a] ? result_.best : measure_at("scan", point));
      }
    }
    result_.scans.push_back(std::move(scan));
  }

  const TuneInput& in_;
  TuneGoal goal_;
  TuneJournal& journal_;
  const TuneProgress& progress_;
  std::size_t limit_ = 0;
  Clock::time_point start_;
  std::optional<std::size_t> exact_;
  std::vector<std::size_t> words_, numbers_;
  std::vector<double> constants_;
  std::map<std::string, std::size_t> seen_;
  std::optional<TuneScore> best_;
  TuneResult result_;
};

}  // namespace

std::size_t default_evaluations(std::size_t axes, std::size_t axes_of_numbers, std::size_t combinations_of_words) {
  return std::max(30 * std::max<std::size_t>(1, axes), 15 * axes_of_numbers * combinations_of_words);
}

TuneResult tune(const TuneInput& input, TuneJournal& journal, const TuneProgress& progress) {
  return Tuner(input, journal, progress).run();
}

}  // namespace umbrameter
