// Wrong taps whose sample lies on another surface by the two-plane rule, and that ray tests check: false occlusion can
// become acne. The surface points to test, and the update of counts with the results. raytrace/surface_judge.h traces
// the rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/gbuffer.h"
#include "scenes/scene.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/filter.h"
#include "techniques/shadow/histogram.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// Agreement of the two-plane rule with the ray tests, in weights of taps.
struct ClassAgreement {
  std::uint64_t wrong = 0;         ///< all wrong taps
  std::uint64_t unresolved = 0;    ///< wrong taps that are false occlusion by the two-plane rule
  std::uint64_t reclassified = 0;  ///< unresolved taps that ray tests reclassified as acne
  std::uint64_t taps = 0;          ///< number of ray-tested taps, not weighted
  /// Wrong taps that are peter-panning by the two-plane rule and, of those, the ones whose sample rays find on the
  /// receiver's own layer: light leak. They are counted here and not reclassified.
  std::uint64_t peter_panning = 0;
  std::uint64_t on_own_layer = 0;
};
/// `reclassified` as a share of `unresolved` or of `wrong`, 0 to 1; 0 if the whole is 0.
double share_of_unresolved(const ClassAgreement& agreement);
double share_of_wrong(const ClassAgreement& agreement);
/// `on_own_layer` as a share of `peter_panning`, 0 to 1; 0 if there is none.
double share_on_own_layer(const ClassAgreement& agreement);

/// The index of a tap's pixel in images.
std::size_t pixel_of(const UnresolvedTap& tap, const GBuffer& gbuffer);

/// The points that a tap compares: the receiver, on its triangle and without normal offset, and the map's sample.
TapSurfaces surfaces_of(const Scene& scene, const MapLayout& layout, const GBuffer& gbuffer, const UnresolvedTap& tap);
std::vector<TapSurfaces> surfaces_of(const Scene& scene, const MapLayout& layout, const GBuffer& gbuffer,
                                     std::span<const UnresolvedTap> taps);

/// Reclassifies the taps with is_same_surface[i] = 1 from false occlusion to acne, in the counts of their pixels or of
/// their histogram bins. Squared and largest errors do not change, because they do not depend on the cause. Each tap
/// may be passed once. Throws Error (no_backend) if a tap is missing from the counts of its pixel or bin.
void reclassify(WrongTaps& wrong, const GBuffer& gbuffer, std::span<const UnresolvedTap> taps,
                std::span<const std::uint8_t> is_same_surface);
void reclassify(BiasHistogram& histogram, std::span<const UnresolvedTap> taps,
                std::span<const std::uint8_t> is_same_surface);

/// Adds the tested taps of lit pixels.
void add_reclassified(ClassAgreement& agreement, std::span<const UnresolvedTap> taps,
                      std::span<const std::uint8_t> is_same_surface);

/// Adds the tested taps of blocked pixels.
void add_blocked(ClassAgreement& agreement, std::span<const UnresolvedTap> taps,
                 std::span<const std::uint8_t> is_own_layer);

}  // namespace umbrameter
