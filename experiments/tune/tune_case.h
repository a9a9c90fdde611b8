// One of the situations over which a tuning takes the mean: a scene, a camera and a light, and other fixed values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/jackknife.h"
#include "experiments/stages/stages.h"
#include "experiments/sweep/sweep_evaluator.h"
#include "results/tune_goal.h"

namespace umbrameter {

struct TuneCase {
  Stages* stages = nullptr;
  Experiment experiment;  ///< in metres; camera and, for shadows, light are set
  SweptQuantity quantity = SweptQuantity::visibility;
  std::uint32_t light = 0;  ///< of shadows
  std::string title;        ///< "courtyard, camera overview, sun"
};

std::vector<std::string> titles_of(const std::vector<TuneCase>& cases);

/// Throws Error (usage) if the experiment's technique does not report one of the goal's columns for this light.
void require_statistics(const TuneCase& tuned, const TuneGoal& goal);

/// Traces the case's reference, or reads it from the cache.
void prepare(const TuneCase& tuned);

/// The case's experiment with these values of the axes.
Experiment at_point(const TuneCase& tuned, const std::vector<TuneAxis>& axes, const std::vector<Value>& point);

/// The goal's columns at an experiment. Throws Error (usage) if the case's technique does not report one of them.
CaseValues measure_case(const TuneCase& tuned, const Experiment& experiment, const TuneGoal& goal);

/// Whether one pass measures every constant bias: by causes, with taps that do not depend on the bias, and described
/// statistics alone.
bool has_exact_bias(const TuneCase& tuned, const std::vector<TuneAxis>& axes, const TuneGoal& goal);

/// The goal's columns at each of these constant biases, in the unit of the experiment's. has_exact_bias() must hold.
std::vector<CaseValues> measure_biases_of(const TuneCase& tuned, const Experiment& experiment, const TuneGoal& goal,
                                          const std::vector<double>& constants);

/// The goal's columns over all pixels of a case but those of one block, for each block.
struct BlocksOfCase {
  std::vector<CaseValues> without;
  /// The most that noise of the reference may have added to each column over all pixels, which it can to absolute
  /// errors; empty: to none.
  CaseValues noise{};
  std::vector<BlockPlace> places{};  ///< of the blocks; empty: they are independent
};

/// The image is divided into block_grid² blocks.
inline constexpr int block_grid = 8;

/// The goal's columns over all pixels but those of one block, for each block that holds a counted pixel. Empty where
/// fewer than two blocks are counted, and for the statistics of a shaded image, of which no part can be left out; its
/// image metrics can. The time of a pass is the same in all.
BlocksOfCase measure_without_blocks(const TuneCase& tuned, const Experiment& experiment, const TuneGoal& goal);

}  // namespace umbrameter
