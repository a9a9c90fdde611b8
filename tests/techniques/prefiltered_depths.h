// Kernels of a few depths, and what a filtered map makes of them.
#pragma once

#include <algorithm>
#include <vector>

#include "techniques/shadow/technique.h"

namespace umbrameter::test {

using shared::PrefilterSettings;

inline PrefilterSettings settings_of(int technique, const MomentMapParams& map = {},
                                     const MomentLookupParams& lookup = {}) {
  return make_prefiltered(technique, {}, map, lookup).settings;
}

// Depths of texels of equal weight.
using Depths = std::vector<float>;

// Averaged in double precision and rounded once.
inline vec4 mean_of(const Depths& depths, const PrefilterSettings& settings) {
  dvec4 sum(0.0);
  for (const float z : depths) sum += dvec4(shared::map_values(z, 0, settings));
  return vec4(sum / static_cast<double>(depths.size()));
}

inline float visibility(const Depths& depths, float depth, const PrefilterSettings& settings) {
  return shared::visibility_from(mean_of(depths, settings), depth, settings);
}

inline double exact(const Depths& depths, float depth) {
  const auto lit = std::count_if(depths.begin(), depths.end(), [&](float z) { return z >= depth; });
  return static_cast<double>(lit) / static_cast<double>(depths.size());
}

}  // namespace umbrameter::test
