#include "techniques/shadow/cascades.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "techniques/shadow/fit_warp.h"
#include "techniques/shadow/receiver_volume.h"

namespace umbrameter {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A range of view depths, metres.
struct ViewDepths {
  double nearest = infinity;
  double farthest = 0.0;
};

ViewDepths depths_of(const GBuffer& surfels) {
  ViewDepths range;
  for (std::size_t i = 0; i < surfels.depth.size(); ++i) {
    const auto depth = static_cast<double>(surfels.depth[i]);
    if (!surfels.is_surface(i) || !(depth > 0.0) || !std::isfinite(depth)) continue;
    range.nearest = std::min(range.nearest, depth);
    range.farthest = std::max(range.farthest, depth);
  }
  return range;
}

// Logarithmic splits need a near plane in front of the camera; an orthographic camera may have none.
ViewDepths depths_of(const View& view, double max_distance) {
  constexpr double least_share = 1e-3;
  const ViewDepths planes = std::visit(
      [](const auto& projection) {
        return ViewDepths{projection.near_plane, projection.far_plane};
      },
      view.camera.projection);
  const double farthest = std::min(planes.farthest, max_distance);
  const ViewDepths range{planes.nearest > 0.0 ? planes.nearest : least_share * farthest, farthest};
  if (!(range.nearest < range.farthest)) {
    throw Error(ExitCode::usage, "shadow.max-distance", "the camera's near plane is no nearer",
                "give more than " + to_string(Value(range.nearest)) + " m");
  }
  return range;
}

/// Around the frustum between two view depths.
struct Sphere {
  dvec3 center;
  double radius;
};

// Its centre is on the camera's axis. Of a perspective frustum whose corners are k times their depth off the axis, the
// near and the far corners are equally distant from the depth (n + f)(1 + k²)/2; beyond f, the far corners decide.
Sphere bounding_sphere(const View& view, const ViewDepths& range) {
  assert(view.width > 0 && view.height > 0);
  const double diagonal = std::hypot(static_cast<double>(view.width) / view.height, 1.0);
  double depth = 0.5 * (range.nearest + range.farthest);
  double corner = 0.0;
  if (const auto* flat = std::get_if<OrthographicProjection>(&view.camera.projection)) {
    corner = flat->half_height * diagonal;
  } else {
    const double k = std::tan(0.5 * std::get<PerspectiveProjection>(view.camera.projection).vertical_fov) * diagonal;
    depth = std::min(depth * (1.0 + k * k), range.farthest);
    corner = k * range.farthest;
  }
  return {dvec3(view.camera.world_from_camera * dvec4(0.0, 0.0, -depth, 1.0)),
          std::hypot(corner, range.farthest - depth)};
}

// The camera's view depth as a plane in light space; light space is rigid.
dvec4 view_depth_plane(const MapLayout& layout, const View& view) {
  const dmat4 light_from_camera = layout.light_from_world * view.camera.world_from_camera;
  const dvec3 axis = -dvec3(light_from_camera[2]);
  return {axis, -glm::dot(axis, dvec3(light_from_camera[3]))};
}

// Moves the start of the depth range towards the surfels, never away from them.
void shorten_depth(MapLayout& layout, const GBuffer& surfels, double offset) {
  double nearest = infinity;
  for (std::size_t i = 0; i < surfels.depth.size(); ++i) {
    if (surfels.is_surface(i)) nearest = std::min(nearest, depth_of(layout, dvec3(surfels.position[i])));
  }
  if (!std::isfinite(nearest) || !(nearest > offset)) return;
  const double shift = std::min(nearest - offset, 0.999 * layout.far_depth);
  layout.light_from_world[3].z += shift;
  layout.far_depth -= shift;
}

// Moves the near face of an orthographic map towards the light.
void start_earlier(MapLayout& layout, double shift) {
  layout.light_from_world[3].z -= shift;
  layout.view_depth_plane.w += layout.view_depth_plane.z * shift;
  layout.far_depth += shift;
  if (layout.warp) layout.warp->middle_depth += shift;
}

// Extends an orthographic map's depths by the ground, a horizontal rectangle, as far as the views reach.
void include_ground(MapLayout& layout, const Bounds& ground, bool keeps_start) {
  if (ground.empty()) return;
  const dvec3 up(layout.light_from_world[1]);
  const dvec3 origin(layout.light_from_world * dvec4(ground.center(), 1.0));
  double lowest = infinity;
  double highest = -infinity;
  for (const MapView& view : layout.views) {
    for (int corner = 0; corner < 4; ++corner) {
      const dvec2 sign((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0);
      const dvec2 across = view.center + view.half_extent * sign - dvec2(origin);
      const double z = origin.z - (up.x * across.x + up.y * across.y) / up.z;
      lowest = std::min(lowest, z);
      highest = std::max(highest, z);
    }
  }
  Bounds rectangle;
  for (int i = 0; i < 8; ++i) rectangle.include(dvec3(layout.light_from_world * dvec4(ground.corner(i), 1.0)));
  // A plane that the light sees edge-on divides by zero: it then reaches as far as the rectangle.
  const double room = rounding_room(ground);
  const double shift = std::min(highest, rectangle.max.z) + room;
  layout.far_depth = std::max(layout.far_depth, room - std::max(lowest, rectangle.min.z));
  if (keeps_start || shift <= 0.0) return;
  start_earlier(layout, shift);
}

double nearest_depth(const MapLayout& layout, const std::vector<Bounds>& boxes) {
  double nearest = infinity;
  for (const Bounds& box : boxes) {
    for (int i = 0; i < 8 && !box.empty(); ++i) nearest = std::min(nearest, depth_of(layout, box.corner(i)));
  }
  return nearest;
}

// The depths of MapFit::bounds: half of `length` on either side of a point, and farther where the layout reaches
// farther.
void lengthen_depth(MapLayout& layout, const dvec3& center, double length) {
  const double shift = 0.5 * length - depth_of(layout, center);
  if (shift > 0.0) start_earlier(layout, shift);
  layout.far_depth = std::max(layout.far_depth, depth_of(layout, center) + 0.5 * length);
}

dvec3 to_light(const MapLayout& layout) { return glm::transpose(dmat3(layout.light_from_world))[2]; }

// Fits the views of one map.
class Fitter {
 public:
  Fitter(const MapLayout& layout, const MappedBounds& bounds, const SeenPart& seen, CascadeFit fit, int margin)
      : layout_(layout), bounds_(bounds), seen_(seen), fit_(fit), margin_(margin) {}

  /// The view of what is seen in a range of depths; none if that is empty.
  std::optional<MapView> fit(const ViewDepths& range) const {
    if (fit_ == CascadeFit::stable) return around_frustum(range);
    if (fit_ == CascadeFit::tight) return around_surfels(seen_.surfels, range);
    const double nearest = layout_.selection == CascadeSelection::depth ? range.nearest : 0.0;
    return around_surfels(receiver_volume(seen_.view, to_light(layout_), bounds_.boxes, nearest, range.farthest),
                          range);
  }

 private:
  std::optional<MapView> around_surfels(const GBuffer& surfels, const ViewDepths& range) const {
    // Cascades that are selected by depth hold their own range alone: with room for the rounding of a surfel's depth.
    const bool is_by_depth = layout_.selection == CascadeSelection::depth;
    const double room = is_by_depth ? 1e-6 : 0.0;
    const double nearest = is_by_depth ? range.nearest * (1.0 - room) : -infinity;
    const double farthest = range.farthest * (1.0 + room);
    dvec2 low(infinity);
    dvec2 high(-infinity);
    for (std::size_t i = 0; i < surfels.depth.size(); ++i) {
      const auto depth = static_cast<double>(surfels.depth[i]);
      if (!surfels.is_surface(i) || depth < nearest || depth > farthest) continue;
      const dvec2 place(in_light(dvec3(surfels.position[i])));
      low = glm::min(low, place);
      high = glm::max(high, place);
    }
    const dvec2 extent = high - low;
    const double side = std::max(extent.x, extent.y);
    if (!(side > 0.0)) return std::nullopt;
    return MapView{0.5 * (low + high), 0.5 * side / share_within(2 * margin_)};
  }

  // The area's centre is a whole number of texels from the origin of light space, which does not move with the camera.
  // (M. Valient, Stable Rendering of Cascaded Shadow Maps, ShaderX6, 2008.)
  std::optional<MapView> around_frustum(const ViewDepths& range) const {
    const Sphere sphere = bounding_sphere(seen_.view, range);
    // One texel more than the margin, because the centre moves by up to half a texel.
    const double half_extent = sphere.radius / share_within(2 * margin_ + 1);
    const double texel = 2.0 * half_extent / layout_.resolution;
    return MapView{glm::floor(dvec2(in_light(sphere.center)) / texel + 0.5) * texel, half_extent};
  }

  // Without so many texels, as the share of the map's side. A map that has no more of them gets no margin.
  double share_within(int texels) const {
    return layout_.resolution > texels ? 1.0 - static_cast<double>(texels) / layout_.resolution : 1.0;
  }

  dvec3 in_light(const dvec3& position) const { return dvec3(layout_.light_from_world * dvec4(position, 1.0)); }

  const MapLayout& layout_;
  const MappedBounds& bounds_;
  const SeenPart& seen_;
  CascadeFit fit_;
  int margin_;
};

// The last view is the layout's present one, unless it is to be that of what is seen. `bias_factors`: of each split.
void fit_views(MapLayout& layout, const Fitter& fitter, const std::vector<double>& splits, MapFit last_fit,
               const std::vector<double>& bias_factors) {
  const bool is_by_depth = layout.selection == CascadeSelection::depth;
  const bool has_room = layout.resolution > 2 * map_view_margin;
  std::vector<MapView> views;
  double nearest = layout.nearest_view_depth;
  double previous = nearest;
  for (std::size_t i = 0; has_room && i + 1 < splits.size(); ++i) {
    std::optional<MapView> view = fitter.fit({nearest, splits[i]});
    const MapView& whole = layout.views.back();
    const bool is_finer = view && (last_fit == MapFit::view || view->half_extent < whole.half_extent);
    if (is_by_depth && view && !is_finer) view = whole;
    if (view && (is_finer || is_by_depth)) {
      view->farthest = splits[i];
      view->bias_factor = bias_factors[i];
      views.push_back(*view);
    }
    if (!is_by_depth) continue;
    nearest = splits[i] - layout.blend * (splits[i] - previous);
    previous = splits[i];
  }
  if (last_fit == MapFit::view)
    layout.views.back() = fitter.fit({nearest, splits.back()}).value_or(layout.views.back());
  views.push_back(layout.views.back());
  views.back().bias_factor = bias_factors.back();
  layout.views = std::move(views);
}

// The area of a single map that is not the scene's, or the areas of cascades.
MapLayout fit_area(MapLayout layout, const MappedBounds& bounds, const ShadowMapParams& params, const SeenPart& seen,
                   const MapFitParams& fit) {
  MapView whole = layout.views.back();
  if (fit.fit == MapFit::bounds) {
    const dvec4 center(fit.fit_x, fit.fit_y, fit.fit_z, 1.0);
    whole = {dvec2(layout.light_from_world * center), 0.5 * fit.fit_size};
  }
  const bool is_by_camera = fit.split_range == SplitRange::camera;
  const ViewDepths range = is_by_camera ? depths_of(seen.view, fit.max_distance) : depths_of(seen.surfels);
  if (fit.selection == CascadeSelection::depth) {
    layout.selection = CascadeSelection::depth;
    layout.view_depth_plane = view_depth_plane(layout, seen.view);
  }
  layout.is_stable = fit.cascade_fit == CascadeFit::stable;
  layout.nearest_view_depth = range.nearest;
  layout.blend = fit.blend;
  layout.views = {whole};
  if (!(range.nearest <= range.farthest)) return layout;
  std::vector<double> splits = split_depths(range.nearest, range.farthest, params.cascades, fit.split_lambda);
  if (!fit.splits.empty()) {
    const std::vector<double> shares = parse_splits(fit.splits, params.cascades);
    std::ranges::transform(shares, splits.begin(),
                           [&](double share) { return range.nearest + share * (range.farthest - range.nearest); });
  }
  fit_views(layout, Fitter(layout, bounds, seen, fit.cascade_fit, fit_margin(params.cascades, fit)), splits, fit.fit,
            parse_cascade_bias(fit.cascade_bias, params.cascades));
  if (fit.fit == MapFit::view && is_by_camera) {
    layout.views.back().farthest = range.farthest;
    layout.fade_start = (1.0 - fit.fade) * range.farthest;
  }
  return layout;
}

}  // namespace

std::vector<double> split_depths(double nearest, double farthest, int count, double lambda) {
  std::vector<double> splits;
  for (int i = 1; i <= count; ++i) {
    const double share = static_cast<double>(i) / count;
    const double logarithmic = nearest * std::pow(farthest / nearest, share);
    const double uniform = nearest + share * (farthest - nearest);
    splits.push_back(lambda * logarithmic + (1.0 - lambda) * uniform);
  }
  return splits;
}

MapLayout fit_map(const Light& light, const MappedBounds& bounds, const ShadowMapParams& params, const SeenPart& seen,
                  const MapFitParams& fit) {
  const bool is_directional = std::holds_alternative<DirectionalLight>(light.shape);
  MapLayout layout = fit_light(light, is_directional ? bounds.scene : bounds.all(), params.resolution);
  if (!is_directional) return layout;
  if (fit.pancaking) shorten_depth(layout, seen.surfels, fit.near_offset);
  const bool has_boxes = fit.cascade_fit == CascadeFit::boxes;
  const double farthest = fit.split_range == SplitRange::camera ? fit.max_distance : infinity;
  const GBuffer volume =
      has_boxes ? receiver_volume(seen.view, to_light(layout), bounds.boxes, 0.0, farthest) : GBuffer();
  const SeenPart part{has_boxes ? volume : seen.surfels, seen.view};
  if (params.cascades > 1 || fit.fit != MapFit::scene || !fit.cascade_bias.empty()) {
    layout = fit_area(layout, bounds, params, part, fit);
  }
  if (fit.warp == Warp::lispsm && can_warp(params.cascades, fit)) {
    warp_map(layout, part, fit, nearest_depth(layout, bounds.boxes));
  }
  include_ground(layout, bounds.ground, fit.pancaking);
  if (fit.fit == MapFit::bounds && fit.fit_depth > 0.0) {
    lengthen_depth(layout, {fit.fit_x, fit.fit_y, fit.fit_z}, fit.fit_depth);
  }
  if (fit.cascade_bias == own_range) {
    for (MapView& view : layout.views) {
      view.range_share = (2.0 * view.half_extent + fit.near_offset) / layout.far_depth;
    }
  }
  return layout;
}

}  // namespace umbrameter
