// The two-plane rule on the CPU: whether a tap's sample and the receiver are on the same surface. The derivation is in
// shaders/same_surface.glsl, which gives the same result.
#pragma once

#include "scenes/scene.h"
#include "tests/support/reference/taps.h"

namespace umbrameter {

/// Whether a wrong tap is due to a surface other than the receiver's: false occlusion if the pixel is lit in the
/// reference, peter-panning if it is blocked. For peter-panning the sample must also be nearer to the light than the
/// receiver, because the bias can only remove the shadow of a nearer sample.
bool is_other_surface(const Scene& scene, const MapLookup& lookup, const Tap& tap, const Receiver& receiver,
                      std::size_t pixel, bool is_lit_in_truth);

}  // namespace umbrameter
