#include "techniques/shadow/cascades.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace umbrameter {
namespace {

struct DepthRange {
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0.0;
};

DepthRange depths_of(const GBuffer& seen) {
  DepthRange range;
  for (std::size_t i = 0; i < seen.depth.size(); ++i) {
    const auto depth = static_cast<double>(seen.depth[i]);
    if (!seen.is_surface(i) || !(depth > 0.0) || !std::isfinite(depth)) continue;
    range.nearest = std::min(range.nearest, depth);
    range.farthest = std::max(range.farthest, depth);
  }
  return range;
}

// The square about the surfels up to that depth; nothing (half_extent 0) where there are none.
MapView view_up_to(const MapLayout& layout, const GBuffer& seen, double depth) {
  dvec2 low(std::numeric_limits<double>::infinity());
  dvec2 high(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < seen.depth.size(); ++i) {
    if (!seen.is_surface(i) || static_cast<double>(seen.depth[i]) > depth) continue;
    const dvec2 place(layout.light_from_world * dvec4(dvec3(seen.position[i]), 1.0));
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  if (!(low.x <= high.x)) return {dvec2(0.0), 0.0};
  const dvec2 extent = high - low;
  const double room = 1.0 - 2.0 * map_view_margin / layout.resolution;
  return {0.5 * (low + high), 0.5 * std::max(extent.x, extent.y) / room};
}

}  // namespace

std::vector<double> split_depths(double nearest, double farthest, int count) {
  std::vector<double> splits;
  for (int i = 1; i <= count; ++i) {
    const double share = static_cast<double>(i) / count;
    const double logarithmic = nearest * std::pow(farthest / nearest, share);
    const double uniform = nearest + share * (farthest - nearest);
    splits.push_back(0.5 * (logarithmic + uniform));
  }
  return splits;
}

MapLayout fit_map(const Light& light, const Bounds& bounds, const ShadowMapParams& params, const GBuffer& seen) {
  MapLayout layout = fit_light(light, bounds, params.resolution);
  const bool has_room = params.resolution > 2 * map_view_margin;
  if (layout.kind != MapKind::orthographic || params.cascades == 1 || !has_room) return layout;
  const DepthRange range = depths_of(seen);
  if (!(range.nearest <= range.farthest)) return layout;
  const std::vector<double> splits = split_depths(range.nearest, range.farthest, params.cascades);
  const MapView whole = layout.views.back();
  layout.views.clear();
  for (std::size_t i = 0; i + 1 < splits.size(); ++i) {
    const MapView view = view_up_to(layout, seen, splits[i]);
    if (view.half_extent > 0.0 && view.half_extent < whole.half_extent) layout.views.push_back(view);
  }
  layout.views.push_back(whole);
  return layout;
}

}  // namespace umbrameter
