// A constant bias in the three units that every result states. No images, no rows.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

/// One constant bias: along the light's axis or the point light's ray. Texels are those of the mean size over the
/// counted pixels, so that in a map whose texels grow with the distance from the light metres (or texels) are a mean.
/// NaN where the texel size or the depth range is not known.
struct BiasInUnits {
  double metres = 0.0;
  double texels = 0.0;
  double depth = 0.0;  ///< normalised map depth: a share of the map's depth range
};

/// bias is in metres or texels. mean_texel and depth_range are in metres; 0 where not known.
BiasInUnits in_units(const Length& bias, double mean_texel, double depth_range);

}  // namespace umbrameter
