// Shadow-map look-ups on the CPU; tests compare the shaders' with them. With IEEE 754 arithmetic the results are
// bit-identical to those of light_map.glsl, surfel_lookup.glsl and shadow_filter.glsl.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/gbuffer.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/filter.h"
#include "techniques/shadow/map_layout.h"
#include "techniques/shadow/reference/lookup.h"

namespace umbrameter {

/// Inputs of a look-up.
struct MapLookup {
  const GBuffer& gbuffer;
  const MapLayout& layout;
  const Light& light;
  const ShadowMapImages& map;
  const FilterKernel& filter;
  BiasParams bias{};  ///< of PCSS all; other filters read neither the number of the constant bias nor the slope's
};

/// One depth comparison. texel.y counts rows from the bottom.
struct Tap {
  ivec2 texel{0};
  int view = 0;
  bool has_blocker = false;
  float critical_bias = -std::numeric_limits<float>::infinity();  ///< metres; lit at this bias and above
  std::uint32_t weight = 0;
};

/// Index of a texel in an image of ShadowMapImages, which has the top row first.
inline std::size_t texel_index(const MapLayout& layout, const ivec2& texel) {
  return static_cast<std::size_t>(layout.resolution - 1 - texel.y) * static_cast<std::size_t>(layout.resolution) +
         static_cast<std::size_t>(texel.x);
}

/// A surfel projected to the map.
struct SurfelLookup {
  bool faces_light = false;  ///< geometric N·L > 0
  Receiver receiver;
  float slope = 0.0f;      ///< texel size at the receiver · tan θ, metres
  float bias_unit = 1.0f;  ///< metres per unit of constant bias
};
SurfelLookup look_up(const MapLookup& lookup, std::size_t pixel);

using AxisWeights = std::array<std::uint32_t, FilterKernel::largest_size + 1>;
/// Weights of the texels along a side of a grid, from the left; the rest is 0. `part`: with linear taps, how far right
/// of the middle's left tap the receiver is, in 1/texel_parts texel.
AxisWeights axis_weights(const FilterKernel& filter, std::uint32_t part);

/// Share of the left `x` 1/256 texels of an area tent with `size` texels along a side, in 1/area_sum.
std::uint32_t area_tent_part(std::uint32_t size, std::uint32_t x);

/// All taps of the filter at a surfel, including taps of weight 0.
void fetch_taps(const MapLookup& lookup, const SurfelLookup& surfel, std::size_t pixel, std::vector<Tap>& taps);

/// Visibility at a surfel that faces the light, from the taps of fetch_taps() and the bias of `lookup`.
float visibility_of(const MapLookup& lookup, const SurfelLookup& surfel, const std::vector<Tap>& taps);

}  // namespace umbrameter
