// Looks up the shadow map at every surfel and classifies each wrong tap by cause.
#pragma once

#include "core/image.h"
#include "raster/gl/context.h"
#include "raster/shadow/shadow_lookup.h"
#include "techniques/shadow/causes.h"

namespace umbrameter {

/// Visibility and wrong taps of each surfel.
struct RasterVisibility {
  Image<float> visibility;  ///< 1 lit, 0 blocked; back-facing: 0; background and outside the map: 1
  /// 0 on background, on back-facing surfels, where the truth is below 0, and everywhere if there is no truth. For a
  /// binary truth, the sum of a pixel's weights divided by weight_sum is |visibility − truth|.
  WrongTaps wrong;
};

RasterVisibility draw_visibility(const gl::Context& context, const ShadowLookup& lookup);

}  // namespace umbrameter
