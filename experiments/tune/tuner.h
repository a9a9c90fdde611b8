// The search of a tuning: evaluates points over all cases, with every evaluation in the journal.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/tune/tune_case.h"
#include "experiments/tune/tune_journal.h"
#include "results/tune_results.h"

namespace umbrameter {

struct TuneBudget {
  std::size_t evaluations = 0;  ///< 0: default_evaluations()
  double minutes = 0.0;         ///< 0: no limit
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
