#include "compare/bias_units.h"

#include <cassert>
#include <limits>

namespace umbrameter {

BiasInUnits in_units(const Length& bias, double mean_texel, double depth_range) {
  assert(bias.unit == LengthUnit::metres || bias.unit == LengthUnit::texels);
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const double texel = mean_texel > 0.0 ? mean_texel : unknown;
  BiasInUnits all;
  const bool is_in_texels = bias.unit == LengthUnit::texels;
  all.metres = is_in_texels ? bias.number * texel : bias.number;
  all.texels = is_in_texels ? bias.number : bias.number / texel;
  all.depth = depth_range > 0.0 ? all.metres / depth_range : unknown;
  return all;
}

}  // namespace umbrameter
