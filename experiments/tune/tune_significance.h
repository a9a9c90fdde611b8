// Whether one point is better than another beyond chance: both are measured with each block of pixels left out, so that
// what both have in common cancels (delete-a-group jackknife, Quenouille 1956; Kott 2001).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/statistics.h"
#include "experiments/tune/tuner.h"

namespace umbrameter {

/// Of each case.
using LeftOutBlocks = std::vector<BlocksOfCase>;

/// The blocks of all cases that hold counted pixels, if they are fewer than fewest_blocks: there is no interval then.
/// Else 0.
std::size_t few_blocks(const LeftOutBlocks& blocks);

/// `at` makes the experiment of a case.
LeftOutBlocks leave_out_blocks(const std::vector<TuneCase>& cases, const TuneGoal& goal,
                               const std::function<Experiment(const TuneCase&)>& at);

/// The cost of all cases with its 95 % interval, which covers the choice of pixels and the noise of the reference's
/// rays: these differ from pixel to pixel. Noise can only raise an absolute error, and the interval also holds the cost
/// without what it may have added. It does not cover that the point was chosen for its cost. Nothing where a case has
/// no blocks, and with few_blocks().
///
/// `of_default` are those of the default, of whose costs a relative goal counts multiples: they lose the same blocks
/// and may hold noise, too. Not used by other goals.
std::optional<Estimate> cost_interval(const TuneGoal& goal, const std::vector<CaseValues>& cases,
                                      const LeftOutBlocks& blocks, const LeftOutBlocks& of_default = {});

/// Cost of `a` − cost of `b`, paired. Of a relative goal neither is the default, which costs 1: its cost_interval()
/// says how far a point is from it. Nothing where a case has no blocks, and with few_blocks().
std::optional<Estimate> cost_difference(const TuneGoal& goal, const std::vector<CaseValues>& a,
                                        const LeftOutBlocks& blocks_a, const std::vector<CaseValues>& b,
                                        const LeftOutBlocks& blocks_b, const LeftOutBlocks& of_default = {});

}  // namespace umbrameter
