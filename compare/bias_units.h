// Converts a constant bias to the three units that every result states.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

/// One constant bias in three units, along the light's axis or the point light's ray. Conversion uses the mean size of
/// the units over the counted pixels, so where texels or the unit of the map's depth grow with the distance from the
/// light the converted value is a mean. NaN if a size is unknown.
struct BiasInUnits {
  double metres = 0.0;
  double texels = 0.0;
  double depth = 0.0;  ///< of the depth that the map stores, from 0 to 1
};

/// bias is in metres, texels or the map's depth. mean_texel and depth_unit are the metres of one texel and of one unit
/// of the map's depth; 0 if unknown.
BiasInUnits in_units(const Length& bias, double mean_texel, double depth_unit);

}  // namespace umbrameter
