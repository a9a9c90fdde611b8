// Whether a tap's sample lies on the receiver's own surface, by the two-plane rule: what shaders/same_surface.glsl
// decides, on the processor. The reasons stand there.
#pragma once

#include "scenes/scene.h"
#include "techniques/shadow/reference/lookup.h"

namespace umbrameter {

/// A triangle in light space.
struct Facet {
  dvec3 a{0.0};
  dvec3 ab{0.0};
  dvec3 ac{0.0};
  dvec3 normal{0.0};          ///< unit, on the light's side
  double vertex_error = 0.0;  ///< metres, by which rounding may have moved a vertex
};
Facet facet_of(const Scene& scene, const MapLayout& frame, std::uint32_t instance, std::uint32_t triangle);

/// The point of a facet's plane that is nearest to a position, light space.
dvec3 foot_on(const Facet& facet, const dvec3& position);

/// Where the light's ray meets the facet, light space; on its edge where rasterisation reached past it.
dvec3 sample_on(const Facet& facet, const TexelRay& ray);

/// `own` is the receiver's facet, `blocker` that of the tap.
bool is_same_surface(const MapLayout& frame, const Receiver& receiver, const Facet& own, const Tap& tap,
                     const Facet& blocker);

/// Whether a tap that differs from the truth is due to another surface, nearer to the light, than the receiver's own:
/// false occlusion where the truth is lit, else peter-panning. Only a nearer sample can have been erased by the bias.
bool is_other_surface(const Scene& scene, const MapLookup& lookup, const Tap& tap, const Receiver& receiver,
                      std::size_t pixel, bool is_lit_in_truth);

}  // namespace umbrameter
