// A look-up into a filtered shadow map on the CPU, from the map that was read back.
#pragma once

#include <cstddef>
#include <vector>

#include "tests/support/prefiltered_text.h"
#include "tests/support/reference/taps.h"

namespace umbrameter::testing_scenes {

// The texels that a look-up averages: those under the blur at each corner of the bilinear interpolation.
struct Window {
  std::vector<dvec4> groups;  // mean of map_values()
  double lit_share = 0.0;     // of texels at or behind the receiver
  float depth = 0.0f;         // of the receiver, less the bias
};

inline Window window_at(const MapLayout& layout, const ShadowMapImages& map, const Prefiltered& technique,
                        const test::PrefilteredText& text, const Receiver& receiver, double bias) {
  Window window{std::vector<dvec4>(static_cast<std::size_t>(technique.groups), dvec4(0.0))};
  window.depth = static_cast<float>((receiver.depth - bias) / layout.far_depth);
  const dvec2 place = receiver.texels - 0.5;
  const ivec2 base(glm::floor(place));
  const dvec2 part = place - dvec2(base);
  const int taps = static_cast<int>(technique.blur.size());
  double sum = 0.0;
  for (const float weight : technique.blur) sum += static_cast<double>(weight);
  // Of the separable kernel: the bilinear interpolation adds a texel to the blur.
  const auto weight_of = [&](int offset, double share) {
    const auto blur = [&](int i) {
      return i >= 0 && i < taps ? static_cast<double>(technique.blur[static_cast<std::size_t>(i)]) / sum : 0.0;
    };
    return (1.0 - share) * blur(offset) + share * blur(offset - 1);
  };
  for (int y = 0; y <= taps; ++y) {
    for (int x = 0; x <= taps; ++x) {
      const ivec2 at = glm::clamp(base + ivec2(x, y) - taps / 2, ivec2(0), ivec2(layout.resolution - 1));
      const double weight = weight_of(x, part.x) * weight_of(y, part.y);
      const float depth = map.depth[static_cast<std::size_t>(receiver.view)][texel_index(layout, at)];
      for (int group = 0; group < technique.groups; ++group) {
        window.groups[static_cast<std::size_t>(group)] += weight * dvec4(text.map_values(depth, group));
      }
      if (depth >= window.depth) window.lit_share += weight;
    }
  }
  return window;
}

inline float visibility_of(const Window& window, const test::PrefilteredText& text) {
  float visibility = 0.0f;
  for (std::size_t layer = 0; layer < window.groups.size(); ++layer) {
    visibility = text.visibility_from(dvec4(vec4(window.groups[layer])), static_cast<double>(window.depth),
                                      static_cast<int>(layer), visibility);
  }
  return visibility;
}

// CSM's visibility is a sum of a few stored values, none above 1.
inline float rounding_of(const Window& window, const test::PrefilteredText& text) {
  if (window.groups.size() > 1) return 0.0f;
  return test::change_by_rounding(vec4(window.groups[0]), window.depth, text, 4 * test::half_ulp);
}

}  // namespace umbrameter::testing_scenes
