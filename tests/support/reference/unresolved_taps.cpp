#include "tests/support/reference/unresolved_taps.h"

#include <algorithm>

#include "tests/support/reference/same_surface.h"

namespace umbrameter {
namespace {

std::uint32_t packed(std::size_t x, std::size_t y) { return static_cast<std::uint32_t>(x | y << 16u); }

}  // namespace

std::vector<UnresolvedTap> find_unresolved_taps(const Scene& scene, const MapLookup& of_any_unit,
                                                const Image<float>& truth, const Image<PixelExclusion>& exclusion,
                                                const BiasAxes& axes) {
  MapLookup lookup = of_any_unit;
  lookup.bias.constant.unit = axes.unit;
  const float min_slope = *std::min_element(axes.slope.begin(), axes.slope.end());
  const GBuffer& gbuffer = lookup.gbuffer;
  std::vector<UnresolvedTap> found;
  std::vector<Tap> taps;
  for (std::size_t pixel = 0; pixel < truth.size(); ++pixel) {
    if (exclusion[pixel] != PixelExclusion::none || !(truth[pixel] >= 0.5f)) continue;
    const SurfelLookup surfel = look_up(lookup, pixel);
    if (!surfel.faces_light) continue;
    const auto width = static_cast<std::size_t>(gbuffer.width);
    const std::uint32_t at = packed(pixel % width, static_cast<std::size_t>(gbuffer.height) - 1 - pixel / width);
    fetch_taps(lookup, surfel, pixel, taps);
    for (const Tap& tap : taps) {
      const float flip = flip_bias(tap.critical_bias, surfel.slope, min_slope);
      const bool says_lit = is_lit_at(axes.constant.front(), surfel.bias_unit, flip);
      if (tap.weight == 0 || says_lit || !is_other_surface(scene, lookup, tap, surfel.receiver, pixel, true)) continue;
      const auto face = static_cast<std::size_t>(tap.view);
      const std::size_t texel = texel_index(lookup.layout, tap.texel);
      found.push_back({at, packed(static_cast<std::size_t>(tap.texel.x), static_cast<std::size_t>(tap.texel.y)),
                       static_cast<std::uint32_t>(tap.view), tap.weight, tap.critical_bias, surfel.slope,
                       surfel.bias_unit, lookup.map.instance[face][texel], lookup.map.triangle[face][texel]});
    }
  }
  return found;
}

}  // namespace umbrameter
