#include "results/tune_goal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "core/error.h"
#include "core/lists.h"
#include "results/known_statistics.h"
#include "results/metric_columns.h"

namespace umbrameter {
namespace {

std::size_t add_column(TuneGoal& goal, const KnownStatistic& statistic) {
  for (std::size_t c = 0; c < goal.columns.size(); ++c) {
    if (goal.columns[c].name == statistic.name) return c;
  }
  goal.columns.push_back({statistic.name, statistic.unit, statistic.meaning});
  return goal.columns.size() - 1;
}

KnownStatistic statistic_of(const std::string& text, const std::string& kind, const std::string& option,
                            const std::vector<std::string>& more) {
  if (text == pass_time_statistic) return {kind, text, "ms", "time of the technique's pass, with read-back"};
  StatisticName name = parse_statistic_name(text);
  if (!name.kind.empty() && name.kind != kind) {
    throw Error(ExitCode::usage, option,
                fmt::format("'{}' is of kind {}, but this tuning measures {}", text, name.kind, kind),
                "choose what is measured with --measure");
  }
  name.kind = kind;
  return require_statistic(name, option, more).front();
}

TuneConstraint make_constraint(TuneGoal& goal, const std::string& text, const std::string& kind,
                               const std::vector<TuneAxis>& axes) {
  const std::string option = fmt::format("--constraint '{}'", text);
  TuneConstraint constraint;
  constraint.condition = parse_condition(text, "--constraint");
  const Condition& condition = constraint.condition;
  std::vector<std::string> keys = {pass_time_statistic};
  for (std::size_t a = 0; a < axes.size(); ++a) {
    keys.push_back(axes[a].key());
    if (axes[a].key() != condition.name) continue;
    if (axes[a].is_word()) throw Error(ExitCode::usage, option, axes[a].key() + " is no number");
    constraint.axis = a;
    constraint.bound = in_unit(condition.bound.quantity, axes[a].axis.unit, condition.name, option);
    return constraint;
  }
  Experiment experiment;
  if (find(describe(experiment), condition.name) != nullptr) {
    throw Error(ExitCode::usage, option, "this parameter is not varied",
                fmt::format("add --vary {}=FIRST:LAST", condition.name));
  }
  const KnownStatistic statistic = statistic_of(condition.name, kind, option, keys);
  constraint.column = add_column(goal, statistic);
  constraint.bound = in_unit(condition.bound.quantity, statistic.unit, condition.name, option);
  return constraint;
}

}  // namespace

double violation_of(const TuneConstraint& constraint, double value) {
  if (constraint.condition.is_magnitude) value = std::abs(value);
  const Relation relation = constraint.condition.bound.relation;
  if (holds(value, relation, constraint.bound)) return 0.0;
  if (!std::isfinite(value)) return 1e3;
  constexpr double least_scale = 1e-4;  // of a bound of 0
  return 1e-9 + std::abs(value - constraint.bound) / std::max(std::abs(constraint.bound), least_scale);
}

TuneGoal make_goal(const std::string& cost, const std::vector<std::string>& constraints, const std::string& kind,
                   const std::vector<TuneAxis>& axes, bool worst_case) {
  TuneGoal goal;
  goal.text = cost;
  goal.is_worst_case = worst_case;
  for (const WeightedTerm& term : parse_weighted_sum(cost, "--minimize")) {
    const std::string option = fmt::format("--minimize '{}'", cost);
    const KnownStatistic statistic = statistic_of(term.name, kind, option, {pass_time_statistic});
    if (statistic.is_higher_better && term.weight > 0.0) {
      throw Error(ExitCode::usage, option, statistic.name + " is better when it is higher",
                  fmt::format("write -{:g}*{}", term.weight, statistic.name));
    }
    goal.terms.push_back({term.weight, term.is_magnitude, add_column(goal, statistic)});
  }
  for (const std::string& text : constraints) goal.constraints.push_back(make_constraint(goal, text, kind, axes));
  for (const Column& column : goal.columns) {
    goal.measures_time = goal.measures_time || column.name == pass_time_statistic;
  }
  return goal;
}

TuneGoal relative_to(TuneGoal goal, const std::vector<CaseValues>& of_default) {
  if (!goal.is_relative) return goal;
  for (const CaseValues& values : of_default) {
    const double cost = cost_of(goal, values);
    if (!(cost > 0.0)) {
      throw Error(ExitCode::usage, "--relative",
                  fmt::format("the default has {} of {} in a case", goal.text,
                              std::isnan(cost) ? "no value" : fmt::format("{:g}", cost)),
                  "minimise the cost itself, without --relative");
    }
    goal.of_default.push_back(cost);
  }
  return goal;
}

TuneGoal not_relative(TuneGoal goal) {
  goal.is_relative = false;
  goal.of_default.clear();
  return goal;
}

std::string cost_name(const TuneGoal& goal) {
  if (!goal.is_relative) return goal.text;
  return (goal.terms.size() > 1 ? "(" + goal.text + ")" : goal.text) + " / default";
}

TuneGoal with_metrics(TuneGoal goal, const RunParams& run, const std::string& kind) {
  for (const MetricColumn& column : metric_columns(run, kind == "shadow")) {
    add_column(goal, {kind, column.name, column.unit, column.meaning()});
  }
  return goal;
}

bool is_better(const TuneScore& a, const TuneScore& b) {
  if (std::isnan(a.cost) || std::isnan(b.cost)) return !std::isnan(a.cost);
  return a.violation < b.violation || (a.violation == b.violation && a.cost < b.cost);
}

double to_number(const TuneScore& score) {
  if (std::isnan(score.cost)) return 3.0;
  if (!score.is_kept()) return 1.0 + score.violation / (1.0 + score.violation);
  return 0.5 + std::atan(score.cost) / std::numbers::pi;
}

TuneScore score_from(double number) {
  if (number >= 1.0) return {(number - 1.0) / (2.0 - number), 0.0};
  return {0.0, std::tan((number - 0.5) * std::numbers::pi)};
}

std::vector<std::size_t> objectives_of(const TuneGoal& goal) {
  std::set<std::size_t> columns;
  for (const TuneTerm& term : goal.terms) columns.insert(term.column);
  for (const TuneConstraint& constraint : goal.constraints) {
    if (!constraint.axis) columns.insert(constraint.column);
  }
  return {columns.begin(), columns.end()};
}

double cost_of(const TuneGoal& goal, const CaseValues& values) {
  double cost = 0.0;
  for (const TuneTerm& term : goal.terms) {
    const double value = values[term.column];
    cost += term.weight * (term.is_magnitude ? std::abs(value) : value);
  }
  return cost;
}

bool has_negative_costs(const TuneGoal& goal) {
  return std::ranges::any_of(goal.terms, [&](const TuneTerm& term) {
    return term.weight < 0.0 || (!term.is_magnitude && can_be_negative(goal.columns[term.column].name));
  });
}

double total_cost(const TuneGoal& goal, const std::vector<CaseValues>& cases) {
  double sum = 0.0;
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const double cost = cost_of(goal, cases[c]) / (goal.of_default.empty() ? 1.0 : goal.of_default[c]);
    sum += cost / static_cast<double>(cases.size());
    largest = std::max(largest, cost);
  }
  return goal.is_worst_case && !std::isnan(sum) ? largest : sum;
}

TuneScore score_of(const TuneGoal& goal, const std::vector<Value>& point, const std::vector<CaseValues>& cases) {
  TuneScore score{0.0, total_cost(goal, cases)};
  for (const TuneConstraint& constraint : goal.constraints) {
    if (constraint.axis) {
      score.violation += violation_of(constraint, to_number(point[*constraint.axis]));
      continue;
    }
    for (const CaseValues& values : cases) score.violation += violation_of(constraint, values[constraint.column]);
  }
  return score;
}

bool is_magnitude(const TuneGoal& goal, std::size_t column) {
  return std::ranges::any_of(goal.terms,
                             [&](const TuneTerm& term) { return term.column == column && term.is_magnitude; }) ||
         std::ranges::any_of(goal.constraints, [&](const TuneConstraint& constraint) {
           return !constraint.axis && constraint.column == column && constraint.condition.is_magnitude;
         });
}

std::string shown_name(const TuneGoal& goal, std::size_t column) {
  const std::string& name = goal.columns[column].name;
  return is_magnitude(goal, column) ? "|" + name + "|" : name;
}

bool is_higher_better(const TuneGoal& goal, std::size_t column) {
  for (const TuneTerm& term : goal.terms) {
    if (term.column == column) return term.weight < 0.0;
  }
  for (const TuneConstraint& constraint : goal.constraints) {
    if (!constraint.axis && constraint.column == column) return !is_upper(constraint.condition.bound.relation);
  }
  return is_higher_better(goal.columns[column].name);
}

double aggregate(const TuneGoal& goal, std::size_t column, const std::vector<CaseValues>& cases) {
  if (cases.empty()) return std::numeric_limits<double>::quiet_NaN();
  const bool takes_magnitude = is_magnitude(goal, column);
  const std::vector<double> all = mapped(
      cases, [&](const CaseValues& values) { return takes_magnitude ? std::abs(values[column]) : values[column]; });
  double sum = 0.0;
  for (const double value : all) sum += value / static_cast<double>(all.size());
  if (!goal.is_worst_case || std::isnan(sum)) return sum;
  return is_higher_better(goal, column) ? std::ranges::min(all) : std::ranges::max(all);
}

}  // namespace umbrameter
