// Wrong taps that the two-plane rule calls false occlusion: their list, the surfaces that a judge is asked about, and
// how its verdict changes what was counted. The judge itself traces rays and lives elsewhere.
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

/// How the two-plane rule and the judge agree, in weights of taps.
struct ClassAgreement {
  std::uint64_t wrong = 0;       ///< all wrong taps
  std::uint64_t unresolved = 0;  ///< of them false occlusion by the two-plane rule
  std::uint64_t judged_own = 0;  ///< of those acne by the judge
  std::uint64_t taps = 0;        ///< how many were judged
};
/// 0 to 1; 0 of nothing.
double share_of_unresolved(const ClassAgreement& agreement);
double share_of_wrong(const ClassAgreement& agreement);

/// The pixel of a tap as images count it.
std::size_t pixel_of(const UnresolvedTap& tap, const GBuffer& gbuffer);

/// The receiver's point on its own triangle, without any normal offset, and the one that the map holds.
TapSurfaces surfaces_of(const Scene& scene, const MapLayout& frame, const GBuffer& gbuffer, const UnresolvedTap& tap);
std::vector<TapSurfaces> surfaces_of(const Scene& scene, const MapLayout& frame, const GBuffer& gbuffer,
                                     std::span<const UnresolvedTap> taps);

/// Turns the taps that are judged own (1, one entry a tap) from false occlusion to acne: at their pixels, or in the
/// bins of their flips. A pixel's error does not change by its causes, so that squares and largest errors stay. Each
/// tap may be judged once. Throws Error (no_backend) when one was not counted where its numbers say.
void apply_judgement(WrongTaps& wrong, const GBuffer& gbuffer, std::span<const UnresolvedTap> taps,
                     std::span<const std::uint8_t> own);
void apply_judgement(BiasHistogram& histogram, std::span<const UnresolvedTap> taps, std::span<const std::uint8_t> own);

/// Adds these taps to the agreement.
void add_judgement(ClassAgreement& agreement, std::span<const UnresolvedTap> taps, std::span<const std::uint8_t> own);

}  // namespace umbrameter
