// Runs a sweep that writes its rows to a results store, group by group, and can resume after an interruption.
#pragma once

#include <span>
#include <vector>

#include "core/parallel.h"
#include "experiments/settings/sweep_plan.h"
#include "store/results_store.h"

namespace umbrameter {

/// The columns of a plan's axes, then the measured ones. The kinds of the measured columns are those of the values in
/// `sample`, a measured row.
std::vector<StoredColumn> stored_columns(const Parameters& parameters, const SweepPlan& plan,
                                         const std::vector<Column>& measured, std::span<const Value> sample);

/// Measures a group. Throws what the evaluator throws; std::logic_error if it omits a cell or passes one twice.
void evaluate_whole(const CellGroup& group, const EvaluateGroup& evaluate, const RowSink& keep);

/// Measures the groups that the store lacks, each in one transaction, and finishes the store. Throws what
/// evaluate_whole() throws, and Error if the user interrupts. Groups stored before that stay.
void run_sweep(const SweepPlan& plan, ResultsStore& store, const EvaluateGroup& evaluate,
               const Progress& progress = {});

}  // namespace umbrameter
