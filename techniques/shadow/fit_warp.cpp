#include "techniques/shadow/fit_warp.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace umbrameter {
namespace {

constexpr double least_sine = 0.02;  // of the angle between view and light; Filament's

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double length() const { return high - low; }
};

// Calls visit(position in light space, view depth) for each surfel that the map shall hold.
template <class Visit>
void for_each_surfel(const MapLayout& layout, const SeenPart& seen, const Visit& visit) {
  for (std::size_t i = 0; i < seen.surfels.depth.size(); ++i) {
    const auto depth = static_cast<double>(seen.surfels.depth[i]);
    if (!seen.surfels.is_surface(i) || !(depth > 0.0) || depth > layout.views.back().farthest) continue;
    visit(dvec3(layout.light_from_world * dvec4(dvec3(seen.surfels.position[i]), 1.0)), depth);
  }
}

// Distance of the warp's centre from the nearest surfel along y, metres; none if no warp is as good as one.
std::optional<double> optimal_near(const PerspectiveProjection& camera, const MapFitParams& fit, const Range& depths,
                                   double length, double sine) {
  const double skipped = std::max(0.0, fit.warp_near - camera.near_plane);
  const double share = 3.0 * skipped / depths.length();
  if (!(share < 2.0)) return std::nullopt;
  const double first = std::max(depths.low, std::max(camera.near_plane, fit.warp_near));
  const double last = std::min({depths.high, camera.far_plane, fit.warp_far, depths.low + length * sine});
  const double usual = (depths.low + std::sqrt(first * std::max(last, 0.0))) / sine;
  return std::max(usual, skipped / (2.0 - share));
}

}  // namespace

void warp_map(MapLayout& layout, const SeenPart& seen, const MapFitParams& fit, double nearest) {
  const auto* camera = std::get_if<PerspectiveProjection>(&seen.view.camera.projection);
  if (camera == nullptr) return;
  const dmat4 light_from_camera = layout.light_from_world * seen.view.camera.world_from_camera;
  const dvec2 forward(-light_from_camera[2]);
  const double sine = glm::length(forward);
  if (!(sine > least_sine)) return;
  MapLayout turned = layout;
  const dvec2 y = forward / sine;
  const dmat4 turn =
      glm::transpose(dmat4(dvec4(y.y, -y.x, 0, 0), dvec4(y, 0, 0), dvec4(0, 0, 1, 0), dvec4(0, 0, 0, 1)));
  turned.light_from_world = turn * layout.light_from_world;
  turned.view_depth_plane = turn * layout.view_depth_plane;

  Range depths;
  Range along;
  Range across;
  Range heights;
  for_each_surfel(turned, seen, [&](const dvec3& p, double depth) {
    depths.include(depth);
    along.include(p.y);
    across.include(p.x);
    heights.include(p.z);
  });
  const double farthest = -heights.low;
  if (!(depths.length() > 0.0) || !(farthest > nearest) || !(along.length() > 0.0) || !(across.length() > 0.0)) return;
  const std::optional<double> near = optimal_near(*camera, fit, depths, along.length(), sine);
  if (!near) return;
  const double far = *near + along.length();
  MapWarp warp;
  warp.center = {(turn * light_from_camera[3]).x, along.low - *near};
  warp.middle_depth = 0.5 * (nearest + farthest);
  warp.depth_scale = *near / (farthest - nearest);
  Range u;
  for_each_surfel(turned, seen,
                  [&](const dvec3& p, double) { u.include((p.x - warp.center.x) / (p.y - warp.center.y)); });
  if (!(u.length() > 0.0)) return;
  const int margin = 2 * fit_margin(1, fit);
  const double inner = layout.resolution > margin ? 1.0 - static_cast<double>(margin) / layout.resolution : 1.0;
  warp.scale = inner * dvec2(2.0 / u.length(), -2.0 * *near * far / along.length());
  warp.shift = inner * dvec2(-(u.high + u.low) / u.length(), (far + *near) / along.length());
  const dvec2 low(across.low, along.low);
  const dvec2 high(across.high, along.high);
  turned.views.back().center = 0.5 * (low + high);
  turned.views.back().half_extent = 0.5 * std::max(across.length(), along.length());
  turned.warp = warp;
  layout = turned;
}

}  // namespace umbrameter
