// What a run's rays cost: for people, on stderr, since no two runs take the same time.
#pragma once

#include <cstdint>
#include <string>

#include "raytrace/tracer.h"

namespace umbrameter {

/// Rays of one kind that were traced in this run, not read from the cache.
struct RayCosts {
  std::uint64_t rays = 0;
  double seconds = 0.0;
};

struct Costs {
  BuildStatistics build;  ///< all 0 when nothing had to be built
  RayCosts shadow;
  RayCosts hemisphere;
  double largest_offset = 0.0;  ///< metres
};

void add(RayCosts& costs, const TraceStatistics& statistics);

/// Most memory that the process has held so far, bytes.
std::uint64_t peak_resident_bytes();

/// One line with triangles, build, rays, their rates and the memory; empty when nothing was traced.
std::string costs_text(const Costs& costs);

}  // namespace umbrameter
