// The warp of a directional light's map: where a place across the light falls on it, and how large a texel is there.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/math.h"

namespace umbrameter {

/// A perspective projection along y of light space, across the light: its rays stay parallel and depths stay metres.
/// With w = y − centre.y, above 0, a position is on the map at u = scale.x · (x − centre.x) / w + shift.x and
/// v = scale.y / w + shift.y, both from −1 to 1.
struct MapWarp {
  dvec2 center{0.0};  ///< light space, metres
  dvec2 scale{1.0};   ///< x: 1, above 0; y: metres, below 0, so that v rises with y
  dvec2 shift{0.0};
  /// What the projection's matrix makes of a depth z, from 0 to 1 over the warped volume:
  /// ½ + depth_scale · (z − middle_depth) / w.
  double middle_depth = 0.0;   ///< metres
  double depth_scale = 1.0;    ///< the smallest w of the volume over its range of depths
  bool stores_over_w = false;  ///< the map stores that number, and look-ups compare it; otherwise metres
};

/// (u, v) of a position in light space, whose w is above 0.
inline dvec2 on_warped(const MapWarp& warp, const dvec2& local) {
  const double w = local.y - warp.center.y;
  return {warp.scale.x * (local.x - warp.center.x) / w + warp.shift.x, warp.scale.y / w + warp.shift.y};
}

/// w of a row of the map, at v.
inline double warp_w(const MapWarp& warp, double v) { return warp.scale.y / (v - warp.shift.y); }

/// The inverse of on_warped(). Beyond the horizon, v = shift.y, no position has such a v.
inline dvec2 from_warped(const MapWarp& warp, const dvec2& place) {
  const double w = warp_w(warp, place.y);
  return {(place.x - warp.shift.x) * w / warp.scale.x + warp.center.x, w + warp.center.y};
}

/// The longer side of a texel at a position in light space, metres.
inline double warped_texel(const MapWarp& warp, int resolution, const dvec2& local) {
  const double w = local.y - warp.center.y;
  const double along = (local.x - warp.center.x) / w;
  const double across = w / warp.scale.x;
  const double lengthwise = w * w * std::sqrt(along * along + 1.0) / -warp.scale.y;
  return 2.0 * std::max(across, lengthwise) / static_cast<double>(resolution);
}

}  // namespace umbrameter
