// Prefiltered shadow maps (techniques/shadow/prefiltered.h): the filtered map and the look-up into it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "raster/shadow/technique_passes.h"

namespace umbrameter {

/// What only the look-up reads, packed as std430 packs numbers of 32 bits: LookupValues in
/// shaders/prefiltered_visibility.comp.
struct PrefilteredLookup {
  std::vector<std::byte> values;
};
PrefilteredLookup lookup_of(const BiasParams& bias, const Prefiltered& technique);

inline constexpr std::size_t max_lookups = 64;

/// The visibility of at most max_lookups look-ups in one pass, each the same to the bit as that of draw(). They replace
/// the values of `lookup` and `technique`. lookup.drawn must be the result of filter_map() for the same map and
/// technique; with mipmaps, lookup.view that of the surfels.
std::vector<Image<float>> draw_lookups(const gl::Context& context, const ShadowLookup& lookup,
                                       const Prefiltered& technique, std::span<const PrefilteredLookup> lookups);

}  // namespace umbrameter
