// The text of a technique that filters the shadow map, on the CPU.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string_view>

#include "techniques/shadow/technique.h"

namespace umbrameter::test {

/// Its functions, with the settings of some parameters.
struct PrefilteredText {
  std::function<vec4(float depth, int layer)> map_values;
  std::function<float(const dvec4& values, double depth, int layer, float before)> visibility_from;

  /// Of a technique with one layer per view.
  float visibility(const dvec4& values, double depth) const { return visibility_from(values, depth, 0, 0.0f); }
};

/// Of the chosen technique, which must filter the map.
inline PrefilteredText text_of(const ShadowParams& params) {
  return ShadowTechniques::apply<PrefilteredText>(
      params.technique, [&]<class T>(std::type_identity<T>) -> PrefilteredText {
        if constexpr (FiltersMap<T>) {
          const auto settings = T::settings(params);
          return {[=](float depth, int layer) { return T::Text::map_values(depth, layer, settings); },
                  [=](const dvec4& values, double depth, int layer, float before) {
                    return T::Text::visibility_from(values, depth, layer, before, settings);
                  }};
        } else {
          std::abort();
        }
      });
}

inline std::string_view name_of(ShadowTechniques::Choice technique) {
  return ShadowTechniques::names[static_cast<std::size_t>(technique)];
}

/// Half a unit in the last place of a number near 1.
inline constexpr float half_ulp = 1.0f / (1 << 24);

/// The largest change of the visibility if rounding changes each stored value by at most `part` of itself. A bound from
/// moments is ill-conditioned where the variance is small beside their squares: V/(V + gap²) changes by up to a quarter
/// of the relative change of V.
inline float change_by_rounding(const vec4& values, float depth, const PrefilteredText& text, float part) {
  const float unchanged = text.visibility(dvec4(values), static_cast<double>(depth));
  float change = 0.0f;
  for (unsigned signs = 0; signs < 16; ++signs) {
    vec4 moved = values;
    for (int i = 0; i < 4; ++i) moved[i] *= 1.0f + ((signs >> i & 1u) != 0 ? part : -part);
    change = std::max(change, std::abs(text.visibility(dvec4(moved), static_cast<double>(depth)) - unchanged));
  }
  return change;
}

}  // namespace umbrameter::test
