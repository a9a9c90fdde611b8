#include "compare/bias_units.h"

#include <cassert>
#include <limits>

namespace umbrameter {

BiasInUnits in_units(const Length& bias, double mean_texel, double depth_unit) {
  const auto known = [](double size) { return size > 0.0 ? size : std::numeric_limits<double>::quiet_NaN(); };
  const bool is_in_texels = bias.unit == LengthUnit::texels;
  const bool is_in_depth = bias.unit == LengthUnit::map_depth;
  assert(is_in_texels || is_in_depth || bias.unit == LengthUnit::metres);
  BiasInUnits all;
  all.metres = is_in_texels  ? bias.number * known(mean_texel)
               : is_in_depth ? bias.number * known(depth_unit)
                             : bias.number;
  all.texels = is_in_texels ? bias.number : all.metres / known(mean_texel);
  all.depth = is_in_depth ? bias.number : all.metres / known(depth_unit);
  return all;
}

}  // namespace umbrameter
