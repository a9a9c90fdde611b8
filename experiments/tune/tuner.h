// The search of a tuning: evaluates points over all cases, with every evaluation in the journal.
#pragma once

#include <vector>

#include "experiments/tune/tune_case.h"
#include "experiments/tune/tune_journal.h"
#include "experiments/tune/tune_search.h"

namespace umbrameter {

struct TuneBudget {
  std::size_t evaluations = 0;  ///< SearchInput::evaluations
  double minutes = 0.0;         ///< 0: no limit
};

struct TuneInput {
  const std::vector<TuneAxis>& axes;
  const std::vector<TuneCase>& cases;
  const TuneGoal& goal;
  TuneBudget budget;
  std::vector<Value> given;  ///< the experiments' value of each axis, in its unit: where the search starts
};

/// Throws Error (usage) if no point can be measured. Deterministic unless the budget is in minutes or a time is
/// measured.
TuneResult tune(const TuneInput& input, TuneJournal& journal, const TuneProgress& progress);

}  // namespace umbrameter
