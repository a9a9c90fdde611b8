// The costs of a run: rays and time. They are printed on stderr, not stored with the results, because they differ from
// run to run.
#pragma once

#include <cstdint>

#include "techniques/truth/traced.h"

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

}  // namespace umbrameter
