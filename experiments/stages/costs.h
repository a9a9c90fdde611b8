// The costs of a run: rays, time and memory. They are printed on stderr, not stored with the results, because they
// differ from run to run.
#pragma once

#include <cstdint>

#include "results/costs.h"

namespace umbrameter {

void add(RayCosts& costs, const TraceStatistics& statistics);

/// Peak resident memory of the process so far, bytes.
std::uint64_t peak_resident_bytes();

}  // namespace umbrameter
