// Shadow-map look-ups for every surfel, and which cause each wrong tap has.
#pragma once

#include "core/image.h"
#include "raster/gl/context.h"
#include "raster/shadow/shadow_lookup.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/filter.h"
#include "techniques/shadow/histogram.h"

namespace umbrameter {

/// What a light's map says of each surfel.
struct RasterVisibility {
  Image<float> visibility;  ///< 1 lit, 0 blocked; 0 where turned away, 1 on background; lit off the map
  /// 0 on background, where turned away and where the truth is below 0, and everywhere without a truth. Their sum
  /// over weight_sum is |visibility − truth| where the truth is binary.
  WrongTaps wrong;
};

RasterVisibility draw_visibility(const gl::Context& context, const ShadowLookup& lookup);

}  // namespace umbrameter
