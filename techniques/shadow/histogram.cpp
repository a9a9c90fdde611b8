#include "techniques/shadow/histogram.h"

#include <algorithm>

namespace umbrameter {

float flip_bias(float critical_bias, float slope, float slope_factor) { return critical_bias - slope_factor * slope; }

bool is_lit_at(float bias, float bias_unit, float flip) { return bias * bias_unit >= flip; }

std::size_t bias_bin(const BiasAxes& axes, float flip, float bias_unit) {
  const auto found = std::partition_point(axes.constant.begin(), axes.constant.end(),
                                          [&](float bias) { return !is_lit_at(bias, bias_unit, flip); });
  return static_cast<std::size_t>(found - axes.constant.begin());
}

}  // namespace umbrameter
