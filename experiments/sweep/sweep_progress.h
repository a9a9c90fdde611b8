// The progress of a sweep as one share that combines its cells and the tracing of its references.
#pragma once

#include <cstddef>

#include "experiments/settings/sweep_plan.h"

namespace umbrameter {

/// For each reference, tracing and then measuring its cells count as one half each, because neither cost is known in
/// state. If the reference comes from the cache, its cells count for both halves.
struct SweepProgress {
  std::size_t references = 1;  ///< maximum number of references that the sweep traces
  double cells = 0.0;          ///< share of the cells that are done
  double traced = 0.0;         ///< share of the current reference that is traced
  double share = 0.0;          ///< share of the sweep that is done; never decreases
};

/// The maximum number of references that the axes require.
std::size_t count_references(const SweepPlan& plan);

/// Sets the share of the cells that are done.
void advance_cells(SweepProgress& progress, double cells);

/// Sets the share of the current reference that is traced.
void advance_tracing(SweepProgress& progress, double traced);

}  // namespace umbrameter
