// A sweep whose rows go to a results store, group by group, and which goes on where it was interrupted.
#pragma once

#include <span>
#include <vector>

#include "core/parallel.h"
#include "experiments/results_store.h"
#include "experiments/sweep_plan.h"

namespace umbrameter {

/// The columns of a plan's axes, then measured ones; kinds are those that the values of `sample`, a measured row, have.
std::vector<StoredColumn> stored_columns(const Parameters& parameters, const SweepPlan& plan,
                                         const std::vector<Column>& measured, std::span<const Value> sample);

/// Measures the groups that the store lacks, each in one transaction, and finishes it. Throws what the evaluator
/// throws, and Error when the user interrupts: the groups before it stay. An evaluator that leaves a cell out or gives
/// one twice is a std::logic_error.
void run_sweep(const SweepPlan& plan, ResultsStore& store, const EvaluateGroup& evaluate,
               const Progress& progress = {});

}  // namespace umbrameter
