// What a tuning found: the evaluated points, the best of them, and what it is compared with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/bias_plateau.h"
#include "core/statistics.h"
#include "experiments/settings/tune_axis.h"
#include "results/tune_goal.h"

namespace umbrameter {

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
  std::vector<std::string> unread{};  ///< parameters of other axes that the measurement does not read there
};

struct TuneResult {
  TuneGoal goal;  ///< of a relative one, with the default's costs
  TunePoint best;
  TunePoint before;                    ///< the experiment's values as given: the default
  std::optional<TunePoint> runner_up;  ///< the best measured point that differs by a twentieth of an axis, or in a word
  std::vector<TunePoint>
      points;  ///< every evaluated point, in order, then better ones of scans; with an exact bias the best for each
  std::vector<TunePoint> curve;  ///< with an exact bias: along it, thinned
  /// With an exact bias: along it at the best values of the others, with the cost as the error and the acne of the case
  /// that has most. Empty where no bias keeps the constraints.
  std::optional<BiasPlateau> plateau{};
  BiasEvidence evidence{};           ///< with a plateau: what all cases show about the bias
  std::optional<NoBias> withheld{};  ///< why plateau->recommended is not recommended
  /// The best point with plateau->recommended in place of its constant bias; empty where no bias is recommended, each
  /// of the range leaves acne, or the best point has that bias itself.
  std::optional<TunePoint> recommended{};
  PlateauLimit limit{};  ///< costs up to it are as good as that of the best point
  std::vector<AxisScan> scans;
  std::vector<WordPoint> of_words;  ///< for each axis of words and each of its values that was evaluated
  std::string method;               ///< "all 12 combinations", "DIRECT-L over the whole space, then subplex ..."
  std::size_t evaluations = 0;      ///< points of the search, without those that a scan found to be better
  /// Of a search in combinations of words, the default: fewer may miss the best point with a word. 0 without words.
  std::size_t usual_evaluations = 0;
  std::size_t allowed_evaluations = 0;  ///< what it might have taken; of one that is stopped by time, what it took
  bool is_exact = false;                ///< the constant bias is measured at all values at once
  std::string stopped_by{};             ///< "2.0 minutes"; empty if the search ended by itself or by evaluations
};

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
  std::vector<std::string> cases;  ///< their titles
  TunePoint before, best;
  std::optional<Estimate> difference{};              ///< best − default
  std::optional<TunePoint> recommended{};            ///< TuneResult::recommended here
  std::optional<Estimate> recommended_difference{};  ///< recommended − default
  std::size_t few_blocks = 0;  ///< that hold counted pixels, where they are too few for an interval; else 0
};

struct TuneJudgement {
  std::optional<Estimate> best;            ///< cost, with its interval
  std::size_t few_blocks = 0;              ///< that hold counted pixels, where they are too few for an interval; else 0
  std::optional<Estimate> against_before;  ///< best − default
  std::optional<Estimate> against_runner_up;  ///< best − runner-up
  bool covers_rays = false;  ///< a reference is sampled, so that the intervals cover the noise of its rays, too
  std::vector<ComparedPoint> compared;  ///< the default, then the best point with each word, or the best point
  std::optional<HeldOut> held_out;
};

struct TuneSummary {
  std::vector<TuneAxis> axes;
  std::vector<std::string> cases;  ///< their titles
  TuneGoal goal;
  TuneGoal shown;  ///< the goal, with the columns that are only shown
  TuneResult result;
  TuneJudgement judgement;
  std::vector<std::string> warnings{};  ///< what the cost does not show
};

/// The point to use: the recommended one, or the best where no other is recommended.
const TunePoint& point_to_use(const TuneResult& result);

}  // namespace umbrameter
