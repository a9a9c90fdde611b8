// Whether a tap's sample lies on the receiver's own surface, by the two-plane rule: what shaders/own_surface.glsl
// decides, on the processor. The reasons stand there.
#pragma once

#include "compare/shadow_lookup.h"
#include "scenes/scene.h"

namespace umbrameter {

/// A triangle in light space.
struct Facet {
  dvec3 a{0.0};
  dvec3 ab{0.0};
  dvec3 ac{0.0};
  dvec3 normal{0.0};          ///< unit, on the light's side
  double vertex_error = 0.0;  ///< metres, by which rounding may have moved a vertex
};
Facet facet_of(const Scene& scene, const LightFrame& frame, std::uint32_t instance, std::uint32_t triangle);

/// `own` is the receiver's facet, `blocker` that of the tap.
bool is_own_surface(const LightFrame& frame, const Receiver& receiver, const Facet& own, const Tap& tap,
                    const Facet& blocker);

}  // namespace umbrameter
