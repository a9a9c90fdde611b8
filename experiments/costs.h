// The costs of a run: rays, time and memory. They are printed on stderr, not stored with the results, because they
// differ from run to run.
#pragma once

#include <cstdint>
#include <string>

#include "raytrace/tracer.h"

namespace umbrameter {

/// Rays of one kind that this run traced. Results read from the cache are not included.
struct RayCosts {
  std::uint64_t rays = 0;
  double seconds = 0.0;
};

struct Costs {
  BuildStatistics build;  ///< all 0 if nothing was built
  RayCosts shadow;
  RayCosts hemisphere;
  double largest_offset = 0.0;  ///< metres
};

void add(RayCosts& costs, const TraceStatistics& statistics);

/// Peak resident memory of the process so far, bytes.
std::uint64_t peak_resident_bytes();

/// One line with triangles, build time, rays, ray rates and memory. Empty if nothing was traced.
std::string costs_text(const Costs& costs);

}  // namespace umbrameter
