// The search of a tuning: evaluates points over all cases, with every evaluation in the journal.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/bias_plateau.h"
#include "experiments/tuning/tune_case.h"
#include "experiments/tuning/tune_journal.h"

namespace umbrameter {

struct TuneBudget {
  std::size_t evaluations = 0;  ///< 0: default_evaluations()
  double minutes = 0.0;         ///< 0: no limit
};

/// One evaluated point.
struct TunePoint {
  std::vector<Value> values;  ///< of each axis
  std::vector<CaseValues> cases;
  TuneScore score;
};

/// The cost along one axis while the others keep their best values.
struct AxisScan {
  std::size_t axis = 0;
  std::vector<TunePoint> points;  ///< in the order of the axis
};

/// The best point that was found with one value of an axis of words.
struct WordPoint {
  std::size_t axis = 0;
  TunePoint point;
};

struct TuneResult {
  TuneGoal goal;  ///< of a relative one, with the default's costs
  TunePoint best;
  TunePoint before;                    ///< the experiment's values as given: the default
  std::optional<TunePoint> runner_up;  ///< the best point that differs by a twentieth of an axis, or in a word
  std::vector<TunePoint> points;       ///< every evaluated point, in order; with an exact bias the best for each
  std::vector<TunePoint> curve;        ///< with an exact bias: along it, thinned
  /// With an exact bias: along it at the best values of the others, with the cost as the error and the acne of the case
  /// that has most. Empty where no bias keeps the constraints.
  std::optional<BiasPlateau> plateau{};
  std::vector<AxisScan> scans;
  std::vector<WordPoint> of_words;  ///< for each axis of words and each of its values that was evaluated
  std::string method;               ///< "all 12 combinations", "DIRECT-L, then subplex"
  std::size_t evaluations = 0;
  bool is_exact = false;     ///< the constant bias is measured at all values at once
  std::string stopped_by{};  ///< "2.0 minutes"; empty if the search ended by itself or by evaluations
};

/// Evaluations so far, how many there will be at most, and the best so far.
using TuneProgress = std::function<void(std::size_t done, std::size_t all, const TuneScore& best)>;

struct TuneInput {
  const std::vector<TuneAxis>& axes;
  const std::vector<TuneCase>& cases;
  const TuneGoal& goal;
  TuneBudget budget;
  std::vector<Value> given;  ///< the experiments' value of each axis, in its unit: where the search starts
};

/// 30 for each axis that is searched, and at least 15 for each axis of numbers in each combination of words.
std::size_t default_evaluations(std::size_t axes, std::size_t axes_of_numbers, std::size_t combinations_of_words);

/// Throws Error (usage) if no point can be measured. Deterministic unless the budget is in minutes or a time is
/// measured.
TuneResult tune(const TuneInput& input, TuneJournal& journal, const TuneProgress& progress);

}  // namespace umbrameter
