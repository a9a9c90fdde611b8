#include "experiments/tune/tune_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/error.h"
#include "experiments/tune/minimize.h"

namespace umbrameter {
namespace {

class Search {
 public:
  Search(const SearchInput& input, const AskPoint& ask, const TuneProgress& progress)
      : in_(input), goal_(input.goal), ask_(ask), progress_(progress) {
    for (std::size_t a = 0; a < in_.axes.size(); ++a) {
      if (a != in_.exact) (in_.axes[a].is_word() ? words_ : numbers_).push_back(a);
    }
    limit_ = in_.evaluations > 0 ? in_.evaluations : usual_evaluations();
  }

  TuneResult run() {
    result_.is_exact = in_.exact.has_value();
    result_.before = ask_({TuneQuery::Kind::before, in_.given}, goal_);
    // Nothing is known of a default that is not measured yet.
    if (!result_.before.cases.empty()) {
      goal_ = relative_to(goal_, result_.before.cases);
      result_.before.score = score_of(goal_, result_.before.values, result_.before.cases);
    }
    result_.goal = goal_;
    try {
      search();
    } catch (const SearchEnd& end) {
      result_.stopped_by = end.stopped_by;
    }
    if (result_.points.empty()) throw Error(ExitCode::usage, "tune", "the budget allows no evaluation");
    result_.evaluations = result_.points.size();
    result_.allowed_evaluations = result_.stopped_by.empty() ? limit_ : result_.evaluations;
    result_.best = best_since(0);
    if (std::isnan(result_.best.score.cost)) {
      throw Error(ExitCode::usage, "tune", "no case counts a pixel, so that nothing can be minimised",
                  "choose another camera or light");
    }
    return std::move(result_);
  }

 private:
  // Evaluates a point once.
  TuneScore evaluate(const std::vector<Value>& values) {
    const TuneQuery query{TuneQuery::Kind::point, values};
    const std::string key = key_of(query, in_.exact);
    if (const auto seen = seen_.find(key); seen != seen_.end()) return result_.points[seen->second].score;
    if (result_.points.size() >= limit_) throw SearchEnd{};
    TunePoint point = ask_(query, goal_);
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
    } else if (numbers_.empty() || combinations_of_words() > limit_) {
      throw Error(ExitCode::usage, "--evaluations",
                  fmt::format("{} is fewer than the {} combinations of words", limit_, combinations_of_words()),
                  "give at least as many, or fewer values");
    } else {
      search_numbers();
    }
    if (in_.exact && !(numbers_.empty() && words_.empty())) {
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

  std::size_t usual_evaluations() const {
    return default_evaluations(words_.size() + numbers_.size(), numbers_.size(), combinations_of_words());
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
    result_.method = fmt::format("DIRECT-L over the whole space, then subplex around the best point{}",
                                 words_.empty() ? "" : ", for each combination of words");
    if (!words_.empty()) result_.usual_evaluations = usual_evaluations();
    const std::size_t share = combinations == 1 ? limit_ : limit_ * 8 / 10 / combinations;
    // Few evaluations reach every combination, if not the last search.
    const std::size_t most = limit_ / combinations;
    const std::size_t global = std::min(most, std::max<std::size_t>(2 * numbers_.size() + 1, share * 6 / 10));
    const std::size_t local = std::min(most, std::max(share, global + 1));
    for_each_combination(words_, first_values(), [&](const std::vector<Value>& words) {
      const std::size_t before = result_.points.size();
      search_from(words, in_.given, true, before + global);
      if (combinations > 1) search_from(words, best_since(before).values, false, before + local);
    });
    const std::vector<Value> start = best_since(0).values;
    search_from(start, start, false, limit_ + 1);
  }

  const SearchInput& in_;
  TuneGoal goal_;
  const AskPoint& ask_;
  const TuneProgress& progress_;
  std::size_t limit_ = 0;
  std::vector<std::size_t> words_, numbers_;
  std::map<std::string, std::size_t> seen_;
  std::optional<TuneScore> best_;
  TuneResult result_;
};

std::vector<Value> scanned_values(const TuneAxis& axis, const Value& best) {
  if (axis.is_word() || (!axis.is_continuous && axis.count() <= 8)) return axis.axis.values;
  const double middle = position_of(axis, best);
  std::set<double> positions = {0.0, middle, 1.0};
  for (const double step : {-0.7, -0.4, -0.15, -0.05, 0.05, 0.15, 0.4, 0.7}) {
    positions.insert(std::clamp(middle + step, 0.0, 1.0));
  }
  std::vector<Value> values;
  for (const double position : positions) values.push_back(value_at(axis, position));
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// What the search evaluated on the axis, too.
void add_evaluated(AxisScan& scan, const std::vector<TuneAxis>& axes, const TuneResult& result) {
  for (const TunePoint& point : result.points) {
    std::vector<Value> on_axis = result.best.values;
    on_axis[scan.axis] = point.values[scan.axis];
    const auto has_value = [&](const TunePoint& each) { return each.values == point.values; };
    if (on_axis == point.values && std::ranges::none_of(scan.points, has_value)) scan.points.push_back(point);
  }
  const TuneAxis& axis = axes[scan.axis];
  if (axis.is_word()) return;
  std::ranges::stable_sort(scan.points, {},
                           [&](const TunePoint& point) { return position_of(axis, point.values[scan.axis]); });
}

// The points along each axis from the best one; none along the exact axis.
std::vector<AxisScan> scans_from_best(const SearchInput& input, const TuneResult& result, const AskPoint& ask) {
  std::vector<AxisScan> scans;
  for (std::size_t a = 0; a < input.axes.size(); ++a) {
    AxisScan& scan = scans.emplace_back(AxisScan{a, {}});
    if (a == input.exact) continue;
    for (const Value& value : scanned_values(input.axes[a], result.best.values[a])) {
      std::vector<Value> point = result.best.values;
      point[a] = value;
      const bool is_best = value == result.best.values[a];
      scan.points.push_back(is_best ? result.best : ask({TuneQuery::Kind::scan, point}, result.goal));
    }
    add_evaluated(scan, input.axes, result);
  }
  return scans;
}

constexpr int most_steps = 4;          // from one best point to a better one
constexpr double shown_share = 0.999;  // of the cost: a larger one reads as the same in three digits

// A point whose value is only guessed has no cases.
bool is_shown_better(const TunePoint& point, const TunePoint& best) {
  if (point.cases.empty() || !is_better(point.score, best.score)) return false;
  return point.score.violation < best.score.violation || point.score.cost < shown_share * best.score.cost;
}

const TunePoint* better_point(const TuneResult& result) {
  const TunePoint* better = nullptr;
  for (const AxisScan& scan : result.scans) {
    for (const TunePoint& point : scan.points) {
      if (is_shown_better(point, result.best) && (better == nullptr || is_better(point.score, better->score)))
        better = &point;
    }
  }
  return better;
}

}  // namespace

std::string key_of(const TuneQuery& query, std::optional<std::size_t> exact) {
  if (query.kind == TuneQuery::Kind::before) return "before";
  const bool is_point = query.kind == TuneQuery::Kind::point;
  std::string key = is_point ? "point" : "scan";
  for (std::size_t a = 0; a < query.values.size(); ++a) {
    key += "|" + (is_point && a == exact ? "*" : to_string(query.values[a]));
  }
  return key;
}

std::size_t default_evaluations(std::size_t axes, std::size_t axes_of_numbers, std::size_t combinations_of_words) {
  return std::max(30 * std::max<std::size_t>(1, axes), 15 * axes_of_numbers * combinations_of_words);
}

TuneResult search_points(const SearchInput& input, const AskPoint& ask, const TuneProgress& progress) {
  return Search(input, ask, progress).run();
}

void scan_axes(const SearchInput& input, TuneResult& result, const AskPoint& ask) {
  for (int step = 0;; ++step) {
    result.scans = scans_from_best(input, result, ask);
    const TunePoint* better = step < most_steps && result.stopped_by.empty() ? better_point(result) : nullptr;
    if (better == nullptr) return;
    try {
      TunePoint point = input.exact ? ask({TuneQuery::Kind::point, better->values}, result.goal) : *better;
      if (!is_shown_better(point, result.best)) return;
      result.points.push_back(point);
      result.best = std::move(point);
    } catch (const SearchEnd& end) {
      result.stopped_by = end.stopped_by;
      return;
    }
  }
}

}  // namespace umbrameter
