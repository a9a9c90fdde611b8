// Shadow-map look-ups on the CPU. With IEEE 754 arithmetic the results are bit-identical to those of light_map.glsl,
// surfel_lookup.glsl and shadow_filter.glsl.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/gbuffer.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/filter.h"
#include "techniques/shadow/map_layout.h"

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

/// Where a position falls on the map.
struct Receiver {
  dvec3 in_light{0.0};      ///< light space, metres
  double depth = 0.0;       ///< metres; see MapLayout
  double axis_depth = 0.0;  ///< metres along the axis of the map or face; paraboloid: plus the radial distance
  dvec2 texels{0.0};        ///< position in texels from the map's lower left corner
  ivec2 texel{0};
  int view = 0;
  bool is_inside = false;
  dvec3 plane{0.0};  ///< geometric normal in light space
};
/// dither: threshold of the pixel for blended cascades, dither_at(); 0: no blending.
Receiver project_to_map(const MapLayout& layout, const dvec3& world, double dither = 0.0);

/// One depth comparison. texel.y counts rows from the bottom.
struct Tap {
  ivec2 texel{0};
  int view = 0;
  bool has_blocker = false;
  float critical_bias = -std::numeric_limits<float>::infinity();  ///< metres; lit at this bias and above
  std::uint32_t weight = 0;
};

/// The light's ray through a texel's centre, in light space. The direction is not normalised.
struct TexelRay {
  dvec3 origin{0.0};
  dvec3 direction{0.0, 0.0, -1.0};
};
TexelRay texel_ray(const MapLayout& layout, const ivec2& texel, int view);

/// Depth at which the light's ray through a texel's centre meets the plane of a receiver, metres. Empty if it does not
/// meet its front. The texel may lie outside the map.
std::optional<double> plane_depth(const MapLayout& layout, const Receiver& receiver, const ivec2& texel, int view);

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

/// All taps of the filter at a surfel, including taps of weight 0.
void fetch_taps(const MapLookup& lookup, const SurfelLookup& surfel, std::size_t pixel, std::vector<Tap>& taps);

/// Visibility at a surfel that faces the light, from the taps of fetch_taps() and the bias of `lookup`.
float visibility_of(const MapLookup& lookup, const SurfelLookup& surfel, const std::vector<Tap>& taps);

}  // namespace umbrameter
