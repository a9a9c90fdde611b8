// Minimises a function of some numbers from 0 to 1, of which nothing else is known: DIRECT-L over the whole cube
// (Gablonsky and Kelley 2001), then subplex from the best point (Rowan 1990). Deterministic. The only door to the
// optimiser.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace umbrameter {

struct MinimizeOptions {
  std::size_t dimensions = 1;
  std::size_t global_evaluations = 0;
  std::size_t local_evaluations = 0;
  std::vector<double> start{};  ///< of the local search, unless the global one finds a better point
};

using CubeFunction = std::function<double(const std::vector<double>& position)>;

/// Returns the position of the least value found. Passes on what the function throws.
std::vector<double> minimize(const MinimizeOptions& options, const CubeFunction& function);

}  // namespace umbrameter
