// An axis-aligned box.
#pragma once

#include <limits>

#include "core/math.h"

namespace umbrameter {

struct Bounds {
  dvec3 min{std::numeric_limits<double>::infinity()};
  dvec3 max{-std::numeric_limits<double>::infinity()};

  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  dvec3 center() const { return 0.5 * (min + max); }
  dvec3 extent() const { return max - min; }
  /// Half of the diagonal: radius of the sphere about center() that holds the box.
  double radius() const { return empty() ? 0.0 : 0.5 * glm::length(extent()); }
  void include(const dvec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void include(const Bounds& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
  /// Corner i of 8; bit 0 chooses x, bit 1 y, bit 2 z.
  dvec3 corner(int i) const {
    return {(i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y, (i & 4) != 0 ? max.z : min.z};
  }
};

}  // namespace umbrameter
