// The causes of a shadow error of which only the image is known: a frame of another renderer, whose taps and bias are
// not. Rays show what a shadow map could have stored around a pixel.
#pragma once

#include "core/gbuffer.h"
#include "raytrace/tracer.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// Distances from the pixel, in texels of the layout, at which rays look for what the map could hold. The texel of a
/// nearest tap reaches 0.71.
inline constexpr double frame_cause_reaches[] = {0.35, 0.7};

/// Assigns |drawn − truth| of each pixel that counts to one cause, in WrongTaps of weight_sum 2^24, which holds every
/// single-precision visibility. Too dark: of what the light sees at 16 points around the pixel, the one nearest to the
/// light could have blocked it; if test_same_surface() finds it on the pixel's own surface, or if none is nearer to the
/// light than the pixel, the error is acne, else false occlusion. Too bright: light leak if one of the inner eight
/// points is lit beside the blocker, else peter-panning, because the map must have held the blocker. `truth` is 0 or 1.
WrongTaps causes_by_rays(const Tracer& tracer, const GBuffer& gbuffer, const MapLayout& layout,
                         const Image<PixelExclusion>& exclusion, const Image<float>& truth, const Image<float>& drawn,
                         const Progress& progress = {});

}  // namespace umbrameter
