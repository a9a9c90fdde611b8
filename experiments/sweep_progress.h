// How far a sweep is, as one share: its cells and the tracing of its references.
#pragma once

#include <cstddef>

#include "experiments/sweep_plan.h"

namespace umbrameter {

/// The cells of one reference follow its tracing, and each half counts as much: neither cost is known before. Cells
/// whose reference is not traced, because it is in the cache, count for both halves.
struct SweepAdvance {
  std::size_t references = 1;  ///< how often the sweep traces, at most
  double cells = 0.0;          ///< share of the cells that are done
  double traced = 0.0;         ///< share of the tracing of the reference that is in use
  double share = 0.0;          ///< of all the work; never falls
};

/// How many references the axes ask for, at most.
std::size_t count_references(const SweepPlan& plan);

/// This share of the cells is done.
void advance_cells(SweepAdvance& advance, double cells);

/// This share of a reference is traced.
void advance_tracing(SweepAdvance& advance, double traced);

}  // namespace umbrameter
