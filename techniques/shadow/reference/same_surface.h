// The two-plane rule on the CPU: whether a tap's sample and the receiver are on the same surface. The derivation is in
// shaders/same_surface.glsl, which gives the same result.
#pragma once

#include "scenes/scene.h"
#include "techniques/shadow/reference/lookup.h"

namespace umbrameter {

/// A triangle in light space.
struct Facet {
  dvec3 a{0.0};
  dvec3 ab{0.0};
  dvec3 ac{0.0};
  dvec3 normal{0.0};          ///< unit, towards the light
  double vertex_error = 0.0;  ///< largest displacement of a vertex by rounding, metres
};
Facet facet_of(const Scene& scene, const MapLayout& layout, std::uint32_t instance, std::uint32_t triangle);

/// The point of a facet's plane that is nearest to a position; in light space.
dvec3 foot_on(const Facet& facet, const dvec3& position);

/// Where the light's ray intersects the facet, in light space. If the ray misses it, because rasterisation covers
/// texels slightly outside a triangle, the point is clamped to the facet's edge.
dvec3 sample_on(const Facet& facet, const TexelRay& ray);

/// `own` is the receiver's facet, `blocker` the facet of the tap's sample.
bool is_same_surface(const MapLayout& layout, const Receiver& receiver, const Facet& own, const Tap& tap,
                     const Facet& blocker);

/// Whether a wrong tap is due to a surface other than the receiver's: false occlusion if the pixel is lit in the
/// reference, peter-panning if it is blocked. For peter-panning the sample must also be nearer to the light than the
/// receiver, because the bias can only remove the shadow of a nearer sample.
bool is_other_surface(const Scene& scene, const MapLookup& lookup, const Tap& tap, const Receiver& receiver,
                      std::size_t pixel, bool is_lit_in_truth);

}  // namespace umbrameter
