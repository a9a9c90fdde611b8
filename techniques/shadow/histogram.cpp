#include "techniques/shadow/histogram.h"

#include <algorithm>

namespace umbrameter {

float flip_of(float critical_bias, float slope, float slope_factor) { return critical_bias - slope_factor * slope; }

bool lights(float bias, float bias_unit, float flip) { return bias * bias_unit >= flip; }

std::size_t bin_of(const BiasAxes& axes, float flip, float bias_unit) {
  const auto found = std::partition_point(axes.constant.begin(), axes.constant.end(),
                                          [&](float bias) { return !lights(bias, bias_unit, flip); });
  return static_cast<std::size_t>(found - axes.constant.begin());
}

}  // namespace umbrameter
