// What the best point of a tuning is compared with once the search has ended: the default, the runner-up, the best
// point with each word, and cases that the search did not see.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "experiments/tuning/tune_significance.h"

namespace umbrameter {

/// A point beside the best one.
struct ComparedPoint {
  std::optional<std::size_t> axis;  ///< of words, of which it is the best point with its value; nothing: the default
  TunePoint point;
  std::vector<CaseValues> shown;       ///< the columns of JudgeInput::shown in each case
  std::optional<Estimate> difference;  ///< its cost − the cost of the best point, paired
  bool is_best = false;
};

/// The check on cases that the search did not see.
struct HeldOut {
  std::vector<TuneCase> cases;
  TunePoint before, best;
  std::optional<Estimate> difference;  ///< best − default
};

struct TuneJudgement {
  std::optional<Estimate> best;               ///< cost, with its interval
  std::optional<Estimate> against_before;     ///< best − default
  std::optional<Estimate> against_runner_up;  ///< best − runner-up
  std::vector<ComparedPoint> compared;        ///< the default, then the best point with each word, or the best point
  std::optional<HeldOut> held_out;
};

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
