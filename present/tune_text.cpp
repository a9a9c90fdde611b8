#include "present/tune_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/settings/sweep_plan.h"
#include "present/plateau_text.h"
#include "present/presentation.h"
#include "results/number_text.h"

namespace umbrameter {

std::string statistic_text(double value, const std::string& unit) {
  if (!std::isfinite(value)) return "—";
  if (unit == "1") return percent(value);
  if (unit == "m") return metres_text(value);
  return with_minus(fmt::format("{:.3g} {}", value, unit));
}

std::string tolerance_text(const TuneSummary& summary) {
  const PlateauLimit& limit = summary.result.limit;
  // One pixel counts more in the mean of the cases where its case has fewer.
  if (limit.is_by_pixels && summary.cases.size() > 1)
    return digits_text(100.0 * (limit.error - summary.result.best.score.cost), 2) +
           " percentage points (three wrong pixels of all cases)";
  return tolerance_text(limit.is_by_pixels);
}

std::string column_words(const TuneGoal& goal, std::size_t column) {
  const std::string words = statistic_words(goal.columns[column].name);
  return is_magnitude(goal, column) ? "|" + words + "|" : words;
}

std::string cost_words(const TuneGoal& goal) {
  const std::size_t first = goal.terms.front().column;
  if (goal.terms.size() > 1 || goal.text != shown_name(goal, first)) return cost_name(goal);
  return column_words(goal, first) + (goal.is_relative ? " / default" : "");
}

std::string cost_unit(const TuneGoal& goal) {
  if (goal.is_relative) return "1";
  std::string unit;
  for (const TuneTerm& term : goal.terms) {
    const std::string& of_term = goal.columns[term.column].unit;
    if (!unit.empty() && unit != of_term) return "";
    unit = of_term;
  }
  return unit;
}

std::string of_cases_text(const TuneGoal& goal, std::size_t cases, bool is_of_two) {
  if (cases < 2) return {};
  if (!goal.is_worst_case) return fmt::format(", the mean of {} cases", cases);
  return fmt::format(", {}the worst of {} cases", is_of_two ? "each " : "", cases);
}

std::string cost_text(const TuneGoal& goal, double value, const std::optional<Estimate>& interval) {
  const std::string unit = cost_unit(goal);
  // A ratio to itself has an interval of rounding alone.
  if (!interval || !(interval->upper - interval->lower > 1e-9 * std::abs(value))) return statistic_text(value, unit);
  return unit == "1" ? percent(*interval) : estimate_text(*interval, unit);
}

std::string difference_text(const TuneGoal& goal, double value, const std::optional<Estimate>& interval,
                            const char* points) {
  std::string text = cost_text(goal, value, interval);
  if (text.find(" to ") != std::string::npos) {
    // A range does not show the value.
    const std::string plain = cost_text(goal, value);
    const std::string number = plain.substr(0, plain.find(' '));
    const std::string unit = plain.substr(number.size());
    text = fmt::format("{} ({}){}", number, text.substr(0, text.size() - unit.size()), unit);
  }
  if (text.ends_with('%')) text.replace(text.size() - 1, 1, points);
  return text;
}

std::string value_text(const TuneAxis& axis, const Value& value, int digits) {
  const auto* number = std::get_if<double>(&value);
  // The tuned file has all digits; values that differ in the fourth cost the same.
  std::string text =
      number != nullptr
          ? with_minus(fmt::format("{:.{}g}", halves_up(*number), std::abs(*number) < 100.0 ? digits : digits + 2))
          : to_string(value);
  // A length in another unit than the axis's.
  if (std::holds_alternative<std::string>(value) && !axis.is_word()) {
    if (const std::optional<Length> length = parse_length(text)) return length_text(*length);
  }
  const std::string& unit = axis.axis.unit;
  if (number != nullptr && std::isfinite(*number) && unit == "m") return metres_text(*number, digits);
  return axis.is_word() ? text : with_unit(text, unit);
}

std::string point_text(const std::vector<TuneAxis>& axes, const std::vector<Value>& values, int digits) {
  std::string text;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const std::string& key = axes[a].key();
    text += fmt::format("{}{} {}", a > 0 ? ", " : "", key.substr(key.find('.') + 1),
                        value_text(axes[a], values[a], digits));
  }
  return text;
}

std::string kept_text(const TuneGoal& goal, const TuneScore& score) {
  if (goal.constraints.empty() || score.is_kept()) return "";
  return goal.constraints.size() == 1 ? " (breaks the constraint)" : " (breaks constraints)";
}

std::string broken_text(const TuneGoal& goal, const TunePoint& point, const std::vector<std::string>& cases) {
  std::string text;
  for (const TuneConstraint& constraint : goal.constraints) {
    if (constraint.axis) continue;
    const auto violation = [&](const CaseValues& values) {
      return violation_of(constraint, values[constraint.column]);
    };
    const auto worst = std::ranges::max_element(point.cases, {}, violation);
    if (worst == point.cases.end() || violation(*worst) == 0.0) continue;
    const Column& column = goal.columns[constraint.column];
    text += fmt::format("{}{} {} in {}", text.empty() ? ": " : "; ", column.name,
                        statistic_text((*worst)[constraint.column], column.unit),
                        cases[static_cast<std::size_t>(worst - point.cases.begin())]);
  }
  return text;
}

int digits_of_best(const TuneSummary& summary) {
  const TuneResult& result = summary.result;
  if (result.recommended &&
      point_text(summary.axes, result.recommended->values) == point_text(summary.axes, result.best.values)) {
    return 5;
  }
  const auto axis = std::ranges::find(summary.axes, constant_bias_key, &TuneAxis::key);
  if (!result.plateau || axis == summary.axes.end()) return 3;
  const double best = to_number(result.best.values[static_cast<std::size_t>(axis - summary.axes.begin())]);
  const BiasPlateau& plateau = *result.plateau;
  // At least those of the range, which holds the best point.
  const int of_range = rounded_inwards(plateau.first.constant, plateau.last.constant, plateau.least.constant).digits;
  const double shown = std::stod(fmt::format("{:.3g}", halves_up(best)));
  return shown < plateau.first.constant || shown > plateau.last.constant ? std::max(5, of_range) : of_range;
}

std::string held_text(const TuneGoal& goal, const TunePoint& point, const std::vector<std::string>& cases) {
  std::string kept = kept_text(goal, point.score);
  if (!kept.empty()) kept.insert(kept.size() - 1, broken_text(goal, point, cases));
  return cost_text(goal, point.score.cost) + kept;
}

}  // namespace umbrameter
