// How far rounding can move what a filtered shadow map's look-up returns.
#pragma once

#include <algorithm>
#include <cmath>

#include "techniques/shadow/prefiltered.h"

namespace umbrameter::test {

/// Half a unit in the last place of a number near 1.
inline constexpr float half_ulp = 1.0f / (1 << 24);

/// The largest change of the visibility if rounding changes each stored value by at most `part` of itself. A bound from
/// moments is ill-conditioned where the variance is small beside their squares: V/(V + gap²) changes by up to a quarter
/// of the relative change of V.
inline float change_by_rounding(const vec4& values, float depth, const shared::PrefilterSettings& settings,
                                float part) {
  const float unchanged = shared::visibility_from(values, depth, settings);
  float change = 0.0f;
  for (unsigned signs = 0; signs < 16; ++signs) {
    vec4 moved = values;
    for (int i = 0; i < 4; ++i) moved[i] *= 1.0f + ((signs >> i & 1u) != 0 ? part : -part);
    change = std::max(change, std::abs(shared::visibility_from(moved, depth, settings) - unchanged));
  }
  return change;
}

}  // namespace umbrameter::test
