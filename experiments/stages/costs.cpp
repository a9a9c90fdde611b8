#include "experiments/stages/costs.h"

#include <sys/resource.h>

namespace umbrameter {
void add(RayCosts& costs, const TraceStatistics& statistics) {
  if (statistics.from_cache) return;
  costs.rays += statistics.rays;
  costs.seconds += statistics.seconds;
}

std::uint64_t peak_resident_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

}  // namespace umbrameter
