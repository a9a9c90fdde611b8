#include "techniques/shadow/cascades.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "core/error.h"
#include "techniques/shadow/fit_warp.h"

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 2> split_range_names{"seen", "camera"};
constexpr std::array<std::string_view, 3> map_fit_names{"scene", "view", "bounds"};
constexpr std::array<std::string_view, 2> cascade_fit_names{"tight", "stable"};

constexpr std::array<std::string_view, 2> cascade_selection_names{"map", "depth"};
constexpr std::array<std::string_view, 2> warp_names{"none", "lispsm"};

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A range of view depths, metres.
struct DepthRange {
  double nearest = infinity;
  double farthest = 0.0;
};

DepthRange depths_of(const GBuffer& surfels) {
  DepthRange range;
  for (std::size_t i = 0; i < surfels.depth.size(); ++i) {
    const auto depth = static_cast<double>(surfels.depth[i]);
    if (!surfels.is_surface(i) || !(depth > 0.0) || !std::isfinite(depth)) continue;
    range.nearest = std::min(range.nearest, depth);
    range.farthest = std::max(range.farthest, depth);
  }
  return range;
}

// Logarithmic splits need a near plane in front of the camera; an orthographic camera may have none.
DepthRange depths_of(const View& view, double max_distance) {
  constexpr double least_share = 1e-3;
  const DepthRange planes = std::visit(
      [](const auto& projection) {
        return DepthRange{projection.near_plane, projection.far_plane};
      },
      view.camera.projection);
  const double farthest = std::min(planes.farthest, max_distance);
  const DepthRange range{planes.nearest > 0.0 ? planes.nearest : least_share * farthest, farthest};
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
Sphere bounding_sphere(const View& view, const DepthRange& range) {
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
  layout.light_from_world[3].z -= shift;
  layout.view_depth_plane.w += layout.view_depth_plane.z * shift;
  layout.far_depth += shift;
}

// Fits the views of one map.
class Fitter {
 public:
  Fitter(const MapLayout& layout, const SeenPart& seen, CascadeFit fit) : layout_(layout), seen_(seen), fit_(fit) {}

  /// The view of what is seen in a range of depths; none if that is empty.
  std::optional<MapView> fit(const DepthRange& range) const {
    if (fit_ == CascadeFit::tight) return around_surfels(range);
    return around_frustum(range);
  }

 private:
  std::optional<MapView> around_surfels(const DepthRange& range) const {
    // Cascades that are selected by depth hold their own range alone: with room for the rounding of a surfel's depth.
    const bool is_by_depth = layout_.selection == CascadeSelection::depth;
    const double room = is_by_depth ? 1e-6 : 0.0;
    const double nearest = is_by_depth ? range.nearest * (1.0 - room) : -infinity;
    const double farthest = range.farthest * (1.0 + room);
    dvec2 low(infinity);
    dvec2 high(-infinity);
    for (std::size_t i = 0; i < seen_.surfels.depth.size(); ++i) {
      const auto depth = static_cast<double>(seen_.surfels.depth[i]);
      if (!seen_.surfels.is_surface(i) || depth < nearest || depth > farthest) continue;
      const dvec2 place(in_light(dvec3(seen_.surfels.position[i])));
      low = glm::min(low, place);
      high = glm::max(high, place);
    }
    const dvec2 extent = high - low;
    const double side = std::max(extent.x, extent.y);
    if (!(side > 0.0)) return std::nullopt;
    return MapView{0.5 * (low + high), 0.5 * side / share_within(2 * map_view_margin)};
  }

  // The area's centre is a whole number of texels from the origin of light space, which does not move with the camera.
  // (M. Valient, Stable Rendering of Cascaded Shadow Maps, ShaderX6, 2008.)
  std::optional<MapView> around_frustum(const DepthRange& range) const {
    const Sphere sphere = bounding_sphere(seen_.view, range);
    // One texel more than the margin, because the centre moves by up to half a texel.
    const double half_extent = sphere.radius / share_within(2 * map_view_margin + 1);
    const double texel = 2.0 * half_extent / layout_.resolution;
    return MapView{glm::floor(dvec2(in_light(sphere.center)) / texel + 0.5) * texel, half_extent};
  }

  // Without so many texels, as the share of the map's side. A map that has no more of them gets no margin.
  double share_within(int texels) const {
    return layout_.resolution > texels ? 1.0 - static_cast<double>(texels) / layout_.resolution : 1.0;
  }

  dvec3 in_light(const dvec3& position) const { return dvec3(layout_.light_from_world * dvec4(position, 1.0)); }

  const MapLayout& layout_;
  const SeenPart& seen_;
  CascadeFit fit_;
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
MapLayout fit_area(MapLayout layout, const ShadowMapParams& params, const SeenPart& seen, const MapFitParams& fit) {
  MapView whole = layout.views.back();
  if (fit.fit == MapFit::bounds) {
    const dvec4 center(fit.fit_x, fit.fit_y, fit.fit_z, 1.0);
    whole = {dvec2(layout.light_from_world * center), 0.5 * fit.fit_size};
  }
  const bool is_by_camera = fit.split_range == SplitRange::camera;
  const DepthRange range = is_by_camera ? depths_of(seen.view, fit.max_distance) : depths_of(seen.surfels);
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
  fit_views(layout, Fitter(layout, seen, fit.cascade_fit), splits, fit.fit,
            parse_cascade_bias(fit.cascade_bias, params.cascades));
  if (fit.fit == MapFit::view && is_by_camera) {
    layout.views.back().farthest = range.farthest;
    layout.fade_start = (1.0 - fit.fade) * range.farthest;
  }
  return layout;
}

// "0.1,0.2,0.5"; nothing if that is no list of numbers.
std::optional<std::vector<double>> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    const auto [next, error] = std::from_chars(at, end, numbers.emplace_back());
    const bool goes_on = error == std::errc{} && next != end && *next == ',' && next + 1 != end;
    if (error != std::errc{} || !std::isfinite(numbers.back()) || (next != end && !goes_on)) return {};
    at = goes_on ? next + 1 : end;
  }
  return numbers;
}

}  // namespace

Parameters describe(MapFitParams& params) {
  return Description("shadow")
      .field("split-lambda", params.split_lambda,
             {.unit = "1", .meaning = "splits of the cascades: 1 logarithmic, 0 uniform", .min = 0, .max = 1})
      .field(
          "splits", params.splits,
          {.unit = {}, .meaning = "ends of the first cascades as shares of the range, '0.1,0.2,0.5'; empty: by lambda"})
      .field(
          "cascade-bias", params.cascade_bias,
          {.unit = {},
           .meaning = "factors of the constant bias in the cascades, '1,2,4', or own-range: the depth of a bias is a "
                      "share of each one's own range"})
      .choice(
          "split-range", params.split_range, split_range_names,
          {.unit = {}, .meaning = "depths that the cascades divide: those seen, or near plane to shadow.max-distance"})
      .field("max-distance", params.max_distance,
             {.unit = "m", .meaning = "farthest depth of the range camera", .min = 1e-6, .max = 1e12})
      .choice("fit", params.fit, map_fit_names,
              {.unit = {}, .meaning = "area of a directional light's only map or last cascade"})
      .field("fit-x", params.fit_x, {.unit = "m", .meaning = "centre of the area bounds, in the world"})
      .field("fit-y", params.fit_y, {.unit = "m", .meaning = "centre of the area bounds, in the world"})
      .field("fit-z", params.fit_z, {.unit = "m", .meaning = "centre of the area bounds, in the world"})
      .field("fit-size", params.fit_size,
             {.unit = "m", .meaning = "side of the area bounds, perpendicular to the light", .min = 1e-6, .max = 1e12})
      .choice("cascade-fit", params.cascade_fit, cascade_fit_names,
              {.unit = {}, .meaning = "area of a cascade: around what is seen, or around the frustum in whole texels"})
      .choice("cascade-selection", params.selection, cascade_selection_names,
              {.unit = {}, .meaning = "cascade of a receiver: the first that contains it, or by its view depth"})
      .field("cascade-blend", params.blend,
             {.unit = "1",
              .meaning = "share of a cascade's extent over which it is blended into the next, by dithering",
              .min = 0,
              .max = 1})
      .field("fade", params.fade,
             {.unit = "1", .meaning = "last share of shadow.max-distance over which shadows fade", .min = 0, .max = 1})
      .choice("warp", params.warp, warp_names,
              {.unit = {}, .meaning = "warp of a single map fitted to the view: none, or light-space perspective"})
      .field("warp-near", params.warp_near,
             {.unit = "m", .meaning = "nearest depth that the warp serves best", .min = 0})
      .field("warp-far", params.warp_far,
             {.unit = "m", .meaning = "farthest depth that the warp serves best", .min = 1e-6})
      .field(
          "pancaking", params.pancaking,
          {.unit = "", .meaning = "start a directional light's depth range at the receivers, clamp casters before it"})
      .field("near-offset", params.near_offset,
             {.unit = "m", .meaning = "pancaking: from the start of the depth range to the nearest receiver", .min = 0})
      .take();
}

bool can_warp(int cascades, const MapFitParams& fit) {
  return cascades == 1 && fit.fit == MapFit::view && fit.cascade_fit == CascadeFit::tight;
}

void require_sense(const ShadowMapParams& map, const MapFitParams& fit, std::span<const Light> lights) {
  const bool any_directional = std::any_of(lights.begin(), lights.end(), [](const Light& light) {
    return std::holds_alternative<DirectionalLight>(light.shape);
  });
  if (any_directional && fit.warp != Warp::none && !can_warp(map.cascades, fit)) {
    throw Error(ExitCode::usage, "shadow.warp", "only a single map that is fitted to the view is warped",
                "use --shadow.cascades 1 --shadow.fit view --shadow.cascade-fit tight");
  }
  if (any_directional) return;
  const auto refuse = [](const std::string& key) {
    throw Error(ExitCode::usage, key, "no measured light is directional, and only directional lights have cascades",
                "leave it out, or select a directional light with --view.light");
  };
  if (map.cascades != 1) refuse("shadow.cascades");
  MapFitParams given = fit;
  MapFitParams usual;
  const Parameters defaults = describe(usual);
  for (const Parameter& parameter : describe(given)) {
    if (parameter.value() != require(defaults, parameter.key).value()) refuse(parameter.key);
  }
}

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

std::vector<double> parse_splits(const std::string& text, int count) {
  const std::optional<std::vector<double>> shares = numbers_of(text);
  const auto is_rising = [](const std::vector<double>& each) {
    return std::ranges::adjacent_find(each, std::greater_equal<>()) == each.end() &&
           (each.empty() || (each.front() > 0.0 && each.back() < 1.0));
  };
  if (shares && is_rising(*shares) && static_cast<int>(shares->size()) == count - 1) return *shares;
  throw Error(ExitCode::usage, "shadow.splits",
              "'" + text + "' does not divide a range among " + std::to_string(count) + " cascades",
              "expected " + std::to_string(count - 1) + " rising numbers between 0 and 1, such as 0.1,0.2,0.5 for 4");
}

std::vector<double> parse_cascade_bias(const std::string& text, int count) {
  if (text.empty() || text == own_range) return std::vector<double>(static_cast<std::size_t>(count), 1.0);
  const std::optional<std::vector<double>> factors = numbers_of(text);
  const auto is_positive = [](double factor) { return factor > 0.0; };
  if (factors && std::ranges::all_of(*factors, is_positive) && static_cast<int>(factors->size()) == count) {
    return *factors;
  }
  throw Error(ExitCode::usage, "shadow.cascade-bias",
              "'" + text + "' is not a factor above 0 for each of " + std::to_string(count) +
                  (count == 1 ? " cascade" : " cascades"),
              "expected " + std::to_string(count) + (count == 1 ? " number" : " numbers, such as 1,2,4 for 3") +
                  ", or own-range");
}

MapLayout fit_map(const Light& light, const MappedBounds& bounds, const ShadowMapParams& params, const SeenPart& seen,
                  const MapFitParams& fit) {
  const bool is_directional = std::holds_alternative<DirectionalLight>(light.shape);
  MapLayout layout = fit_light(light, is_directional ? bounds.scene : bounds.all(), params.resolution);
  if (!is_directional) return layout;
  if (fit.pancaking) shorten_depth(layout, seen.surfels, fit.near_offset);
  if (params.cascades > 1 || fit.fit != MapFit::scene || !fit.cascade_bias.empty()) {
    layout = fit_area(layout, params, seen, fit);
  }
  if (fit.warp == Warp::lispsm && can_warp(params.cascades, fit)) warp_map(layout, seen, fit);
  include_ground(layout, bounds.ground, fit.pancaking);
  if (fit.cascade_bias == own_range) {
    for (MapView& view : layout.views) {
      view.range_share = (2.0 * view.half_extent + fit.near_offset) / layout.far_depth;
    }
  }
  return layout;
}

}  // namespace umbrameter
