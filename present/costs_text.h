// The costs of a run in words.
#pragma once

#include <string>

#include "results/costs.h"

namespace umbrameter {

/// One line with triangles, build time, rays, ray rates and memory. Empty if nothing was traced.
std::string costs_text(const Costs& costs, std::uint64_t peak_resident_bytes);

}  // namespace umbrameter
