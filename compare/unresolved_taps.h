// Wrong taps that are false occlusion by the two-plane rule: the surface points that ray tests need, and the update of
// counts with the results of these tests. raytrace/surface_judge.h traces the rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scenes/scene.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/filter.h"
#include "techniques/shadow/histogram.h"
#include "techniques/shadow/reference/lookup.h"

namespace umbrameter {

/// Agreement of the two-plane rule with the ray tests, in weights of taps.
struct ClassAgreement {
  std::uint64_t wrong = 0;         ///< all wrong taps
  std::uint64_t unresolved = 0;    ///< wrong taps that are false occlusion by the two-plane rule
  std::uint64_t reclassified = 0;  ///< unresolved taps that ray tests reclassified as acne
  std::uint64_t taps = 0;          ///< number of ray-tested taps, not weighted
};
/// reclassified as a share of `unresolved` and of `wrong`, 0 to 1; 0 if there are none.
double share_of_unresolved(const ClassAgreement& agreement);
double share_of_wrong(const ClassAgreement& agreement);

/// The index of a tap's pixel in images.
std::size_t pixel_of(const UnresolvedTap& tap, const GBuffer& gbuffer);

/// The receiver, on its triangle and without normal offset, and the map's sample.
TapSurfaces surfaces_of(const Scene& scene, const MapLayout& layout, const GBuffer& gbuffer, const UnresolvedTap& tap);
std::vector<TapSurfaces> surfaces_of(const Scene& scene, const MapLayout& layout, const GBuffer& gbuffer,
                                     std::span<const UnresolvedTap> taps);

/// Reclassifies from false occlusion to acne the taps with own[i] = 1, at their pixels or in the bins of their flips.
/// Squared and largest errors do not change, because they do not depend on the cause. Each tap may be passed once.
/// Throws Error (no_backend) if a tap is missing from the counts of its pixel or bin.
void reclassify(WrongTaps& wrong, const GBuffer& gbuffer, std::span<const UnresolvedTap> taps,
                std::span<const std::uint8_t> is_same_surface);
void reclassify(BiasHistogram& histogram, std::span<const UnresolvedTap> taps,
                std::span<const std::uint8_t> is_same_surface);

/// Adds these taps to the agreement.
void add_reclassified(ClassAgreement& agreement, std::span<const UnresolvedTap> taps,
                      std::span<const std::uint8_t> is_same_surface);

}  // namespace umbrameter
