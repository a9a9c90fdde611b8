// Converts a constant bias to the three units that every result states.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

/// One constant bias in three units, along the light's axis or the point light's ray. Conversion between metres and
/// texels uses the mean texel over the counted pixels, so for maps whose texels grow with the distance from the light
/// the converted value is a mean. NaN if the texel size or the depth range is unknown.
struct BiasInUnits {
  double metres = 0.0;
  double texels = 0.0;
  double depth = 0.0;  ///< normalised depth: metres / depth range of the map
};

/// bias is in metres or texels. mean_texel and depth_range are in metres; 0 if unknown.
BiasInUnits in_units(const Length& bias, double mean_texel, double depth_range);

}  // namespace umbrameter
