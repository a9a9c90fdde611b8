// Prefiltered shadow maps (techniques/shadow/prefiltered.h): the filtered map and the look-up into it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "raster/shadow/filtered_map.h"
#include "raster/shadow/visibility_pass.h"

namespace umbrameter {

/// The values of each texel, blurred along both axes.
FilteredMap filter(const DrawnMap& drawn, const Prefiltered& technique);

/// What only the look-up reads. Layout std140: LookupValues in shaders/prefiltered_visibility.comp.
struct PrefilteredLookup {
  float constant_bias = 0.0f;  ///< in the unit of ShadowLookup::bias.constant
  float slope_bias = 0.0f;
  float min_variance = 0.0f;
  float bleeding_reduction = 0.0f;
  float moment_bias = 0.0f;
  float ringing_reduction = 0.0f;
  float contrast = 0.0f;
  float unused = 0.0f;
};
PrefilteredLookup lookup_of(const BiasParams& bias, const Prefiltered& technique);

inline constexpr std::size_t max_lookups = 64;

/// The visibility of at most max_lookups look-ups in one pass, each the same to the bit as that of draw(). They replace
/// the values of `lookup` and `technique`. lookup.filtered must be the result of filter() for the same map and
/// technique; with mipmaps, lookup.view that of the surfels.
std::vector<Image<float>> draw_lookups(const gl::Context& context, const ShadowLookup& lookup,
                                       const Prefiltered& technique, std::span<const PrefilteredLookup> lookups);

/// As draw_lookups() for the values of `lookup` and `technique`.
RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const Prefiltered& technique);

}  // namespace umbrameter
