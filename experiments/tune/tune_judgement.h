// What the best point of a tuning is compared with once the search has ended: the default, the runner-up, the best
// point with each word, and cases that the search did not see.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "experiments/tune/tune_significance.h"

namespace umbrameter {

struct JudgeInput {
  const std::vector<TuneAxis>& axes;
  const std::vector<TuneCase>& cases;
  const std::vector<TuneCase>& unseen;
  const TuneGoal& goal;
  const TuneGoal& shown;  ///< the goal, with the columns that are only shown
  const TuneResult& result;
};

/// `progress` takes shares from 0 to 1.
TuneJudgement judge(const JudgeInput& input, const std::function<void(double)>& progress);

}  // namespace umbrameter
