// What a tuning minimises and what it must keep: a weighted sum of statistics, and conditions on statistics and
// parameters.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/condition.h"
#include "core/table.h"
#include "experiments/settings/experiment.h"
#include "experiments/settings/tune_axis.h"

namespace umbrameter {

/// Name of the time that the technique's pass takes, in ms, with read-back; not a described statistic, because it
/// differs from run to run.
inline constexpr const char* pass_time_statistic = "pass_time";

struct TuneTerm {
  double weight = 1.0;
  bool is_magnitude = false;
  std::size_t column = 0;  ///< index into TuneGoal::columns
};

struct TuneConstraint {
  Condition condition;
  double bound = 0.0;               ///< in the unit of the statistic or parameter
  std::optional<std::size_t> axis;  ///< of a varied parameter
  std::size_t column = 0;           ///< else index into TuneGoal::columns
};

struct TuneGoal {
  std::string text;             ///< of the cost: "acne + 0.5*rmse"
  std::vector<Column> columns;  ///< the statistics that are measured, each once
  std::vector<TuneTerm> terms;
  std::vector<TuneConstraint> constraints;
  bool is_worst_case = false;  ///< the largest cost over the cases counts, not their mean
  bool measures_time = false;
  bool is_relative = false;        ///< the cost of each case counts in multiples of its cost at the default
  std::vector<double> of_default;  ///< these costs, one for each case; empty until they are measured
};

/// `kind` is "shadow", "ao" or "image". Throws Error (usage) for unknown names, wrong units, a metric that is better
/// when higher with a positive weight, and a parameter that is not varied.
TuneGoal make_goal(const std::string& cost, const std::vector<std::string>& constraints, const std::string& kind,
                   const std::vector<TuneAxis>& axes, bool worst_case);

/// Values of the goal's columns in one case.
using CaseValues = std::vector<double>;

/// The goal with the default's costs, if it is relative. Throws Error (usage) unless they are above 0.
TuneGoal relative_to(TuneGoal goal, const std::vector<CaseValues>& of_default);
/// The goal in the unit of its cost, for other cases.
TuneGoal not_relative(TuneGoal goal);
/// "rmse", or "rmse / default" of a relative goal.
std::string cost_name(const TuneGoal& goal);

/// The goal with more columns, which it neither minimises nor constrains: the image metrics that run.metrics names.
/// Throws Error (usage) for an unknown name.
TuneGoal with_metrics(TuneGoal goal, const RunParams& run, const std::string& kind);

/// How good a point is: first by how far it breaks the constraints, then by cost.
struct TuneScore {
  double violation = 0.0;  ///< sum of relative excesses over constraints and cases; 0 if all are kept
  double cost = 0.0;       ///< NaN if nothing was measured
  bool is_kept() const { return violation == 0.0; }
};
bool is_better(const TuneScore& a, const TuneScore& b);
/// A number that orders scores as is_better() does, for optimisers.
double to_number(const TuneScore& score);
/// A score of which to_number() is this, above 0 and below 1, or from 1 to below 2.
TuneScore score_from(double number);

/// The columns of the cost and of the constraints on statistics, each once, in order.
std::vector<std::size_t> objectives_of(const TuneGoal& goal);

double cost_of(const TuneGoal& goal, const CaseValues& values);
/// Whether a cost below 0 is possible.
bool has_negative_costs(const TuneGoal& goal);
/// The mean of the cases' costs, or the largest; of a relative goal, in multiples of the default's.
double total_cost(const TuneGoal& goal, const std::vector<CaseValues>& cases);
/// By how much a value breaks a bound, relative to the bound; 0 if it keeps it.
double violation_of(const TuneConstraint& constraint, double value);
TuneScore score_of(const TuneGoal& goal, const std::vector<Value>& point, const std::vector<CaseValues>& cases);
/// Whether the cost or a constraint takes the magnitude of a column.
bool is_magnitude(const TuneGoal& goal, std::size_t column);
/// "acne", or "|mean_error|" where is_magnitude().
std::string shown_name(const TuneGoal& goal, std::size_t column);
/// Whether the larger of two values of a column is the better: as the cost or else a constraint has it, or else as the
/// statistic has it.
bool is_higher_better(const TuneGoal& goal, std::size_t column);
/// The mean of a column over the cases, or the worst with the goal's worst case; of the magnitude where is_magnitude().
double aggregate(const TuneGoal& goal, std::size_t column, const std::vector<CaseValues>& cases);

}  // namespace umbrameter
