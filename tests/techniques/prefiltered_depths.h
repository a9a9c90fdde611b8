// Kernels of a few depths, and what a filtered map makes of them.
#pragma once

#include <algorithm>
#include <vector>

#include "tests/support/prefiltered_text.h"

namespace umbrameter::test {

inline ShadowParams with(ShadowTechniques::Choice technique, ShadowParams params = {}) {
  params.technique = technique;
  return params;
}

// Depths of texels of equal weight.
using Depths = std::vector<float>;

// Averaged in double precision and rounded once.
inline vec4 mean_of(const Depths& depths, const PrefilteredText& text) {
  dvec4 sum(0.0);
  for (const float z : depths) sum += dvec4(text.map_values(z, 0));
  return vec4(sum / static_cast<double>(depths.size()));
}

inline float visibility(const Depths& depths, float depth, const ShadowParams& params) {
  const PrefilteredText text = text_of(params);
  return text.visibility(dvec4(mean_of(depths, text)), static_cast<double>(depth));
}

inline double exact(const Depths& depths, float depth) {
  const auto lit = std::count_if(depths.begin(), depths.end(), [&](float z) { return z >= depth; });
  return static_cast<double>(lit) / static_cast<double>(depths.size());
}

}  // namespace umbrameter::test
