#include "techniques/shadow/map_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/error.h"

namespace umbrameter {
namespace {

constexpr double max_map_angle = 89.9 * pi / 180.0;

dmat4 rigid_inverse(const dmat3& rotation, const dvec3& translation) {
  const dmat3 transposed = glm::transpose(rotation);
  dmat4 inverse(transposed);
  inverse[3] = dvec4(-(transposed * translation), 1.0);
  return inverse;
}

dvec3 in_light_space(const MapLayout& layout, const dvec3& position) {
  return dvec3(layout.light_from_world * dvec4(position, 1.0));
}

MapLayout fit_directional(const dmat3& axes, const Bounds& bounds, int resolution) {
  Bounds box;
  for (int i = 0; i < 8; ++i) box.include(glm::transpose(axes) * bounds.corner(i));
  const double room = rounding_room(bounds);
  const dvec3 extent = box.extent();
  const double side = std::max({extent.x, extent.y, room});
  MapLayout layout;
  layout.kind = MapKind::orthographic;
  layout.views.front().half_extent = 0.5 * side * resolution / std::max(resolution - 2, 1);
  layout.far_depth = extent.z + 2.0 * room;
  const dvec3 origin{box.center().x, box.center().y, box.max.z + room};
  layout.light_from_world = rigid_inverse(axes, axes * origin);
  return layout;
}

bool is_on_view(const MapView& view, const dvec3& local) {
  return std::abs(local.x - view.center.x) <= view.half_extent && std::abs(local.y - view.center.y) <= view.half_extent;
}

}  // namespace

double rounding_room(const Bounds& bounds) { return 1e-6 * (bounds.radius() + glm::length(bounds.center())) + 1e-9; }

dmat3 cube_face(int face) {
  dvec3 forward(0.0);
  forward[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
  const dvec3 up = face / 2 == 1 ? dvec3(0.0, 0.0, 1.0) : dvec3(0.0, 1.0, 0.0);
  return {glm::cross(forward, up), up, forward};
}

std::string view_name(const MapLayout& layout, std::size_t view) {
  constexpr std::array<std::string_view, 6> faces = {"+x", "−x", "+y", "−y", "+z", "−z"};
  if (layout.kind == MapKind::cube) return fmt::format("face {}", faces.at(view));
  if (layout.kind == MapKind::paraboloid) return view == 0 ? "front" : "back";
  return layout.views.size() > 1 ? fmt::format("cascade {}", view + 1) : "";
}

MapLayout fit_light(const Light& light, const Bounds& bounds, int resolution) {
  Bounds fitted = bounds;
  if (fitted.empty()) fitted.include(light.position());
  MapLayout layout;
  if (std::holds_alternative<DirectionalLight>(light.shape)) {
    layout = fit_directional(axes_of(light), fitted, resolution);
  } else {
    const auto* spot = std::get_if<SpotLight>(&light.shape);
    layout.kind = spot != nullptr ? MapKind::perspective : MapKind::cube;
    const double tangent = spot != nullptr ? std::tan(std::clamp(spot->outer_cone_angle, 1e-6, max_map_angle)) : 1.0;
    layout.views.assign(spot != nullptr ? 1 : 6, {dvec2(0.0), tangent});
    layout.light_from_world = rigid_inverse(axes_of(light), light.position());
    const double room = rounding_room(fitted);
    layout.far_depth = room;
    for (int i = 0; i < 8; ++i) {
      layout.far_depth = std::max(layout.far_depth, depth_of(layout, fitted.corner(i)) + room);
    }
  }
  layout.resolution = resolution;
  return layout;
}

double depth_of(const MapLayout& layout, const dvec3& position) {
  const dvec3 local = in_light_space(layout, position);
  return is_omnidirectional(layout.kind) ? glm::length(local) : -local.z;
}

double dither_at(std::uint32_t column, std::uint32_t row) {
  std::uint32_t rank = 0;
  for (std::uint32_t bit = 0; bit < 3; ++bit) {
    rank = rank << 2 | (((column ^ row) >> bit & 1u) << 1) | (row >> bit & 1u);
  }
  return (rank + 0.5) / 64.0;
}

double view_depth(const MapLayout& layout, const dvec3& local) {
  const dvec4& plane = layout.view_depth_plane;
  return plane.x * local.x + plane.y * local.y + plane.z * local.z + plane.w;
}

bool is_in_cascade(const MapLayout& layout, std::size_t view, const dvec3& local, double inset) {
  const MapView& candidate = layout.views[view];
  if (layout.selection == CascadeSelection::depth) {
    const double nearest = view > 0 ? layout.views[view - 1].farthest : layout.nearest_view_depth;
    return view_depth(layout, local) <= candidate.farthest - inset * (candidate.farthest - nearest);
  }
  const double reach = candidate.half_extent * (1.0 - 2.0 * map_view_margin / layout.resolution) * (1.0 - inset);
  const dvec2 offset = glm::abs(dvec2(local) - candidate.center);
  return offset.x <= reach && offset.y <= reach;
}

std::size_t view_of(const MapLayout& layout, const dvec3& local, double dither) {
  std::size_t view = 0;
  if (layout.kind != MapKind::orthographic) return view;
  const std::size_t last = layout.views.size() - 1;
  std::size_t blended = last;  // the cascade out of which the position is blended
  for (; view < last; ++view) {
    if (!is_in_cascade(layout, view, local, 0.0)) continue;
    if (blended != last || is_in_cascade(layout, view, local, layout.blend * dither)) break;
    blended = view;
  }
  if (view == last && blended != last && !is_on_view(layout.views[last], local)) view = blended;
  return layout.uses_neighbour ? std::min(view + 1, last) : view;
}

bool is_faded(const MapLayout& layout, const dvec3& local, double dither) {
  const double depth = view_depth(layout, local);
  if (layout.selection == CascadeSelection::map || !(depth > layout.fade_start)) return false;
  const double share = std::min((depth - layout.fade_start) / (layout.views.back().farthest - layout.fade_start), 1.0);
  return share * share * (3.0 - 2.0 * share) > 1.0 - dither;
}

double far_end_of(const MapLayout& layout) { return layout.encoded_far > 0.0 ? layout.encoded_far : layout.far_depth; }

double metres_per_map_depth(const MapLayout& layout, double depth) {
  const double near = layout.encoded_near;
  const double far = far_end_of(layout);
  // Of decode_depth() in map_depth.glsl: both perspective mappings have the derivative z² (f − n) / (n f).
  return near > 0.0 ? depth * depth * (far - near) / (near * far) : far;
}

double bias_factor(const MapView& view, LengthUnit unit) {
  return unit == LengthUnit::map_depth ? view.bias_factor * view.range_share : view.bias_factor;
}

bool compares_encoded(const MapLayout& layout, LengthUnit bias_unit) {
  return bias_unit == LengthUnit::map_depth && layout.encoded_near > 0.0;
}

bool takes_bias_unit(const MapLayout& layout, LengthUnit unit) {
  if (unit == LengthUnit::map_depth && layout.warp && layout.warp->stores_over_w) return false;
  return !compares_encoded(layout, unit) || layout.kind == MapKind::perspective;
}

void require_bias_unit(const MapLayout& layout, LengthUnit unit) {
  if (takes_bias_unit(layout, unit)) return;
  if (layout.warp && layout.warp->stores_over_w) {
    throw Error(ExitCode::usage, "shadow.constant-bias",
                "a warped map with this shadow.depth-encoding stores depths that are divided by w",
                "give the bias in metres or texels, or use the linear encoding");
  }
  throw Error(ExitCode::usage, "shadow.constant-bias",
              "a cube map with this shadow.depth-encoding stores a depth along each face's axis, not from the light",
              "give the bias in metres or texels, or use the linear encoding");
}

double axis_depth(const MapLayout& layout, const dvec3& local) {
  return layout.kind == MapKind::cube ? std::max({std::abs(local.x), std::abs(local.y), std::abs(local.z)}) : -local.z;
}

double texel_at(const MapLayout& layout, const dvec3& position) {
  const dvec3 local = in_light_space(layout, position);
  if (layout.warp) return warped_texel(*layout.warp, layout.resolution, dvec2(local));
  const double texel = 2.0 * layout.views[view_of(layout, local)].half_extent / layout.resolution;
  if (layout.kind == MapKind::orthographic) return texel;
  if (is_projective(layout.kind)) return texel * std::max(axis_depth(layout, local), 0.0);
  // The projection keeps angles: along both axes the tangent of half the angle grows by 1 / (1 + cos θ).
  return texel * (glm::length(local) + std::abs(local.z));
}

NormalOffset placed_offset(const MapLayout& layout, NormalOffset offset, OffsetTexel texel) {
  if (texel == OffsetTexel::receiver || !layout.warp) return offset;
  const dvec2 middle = from_warped(*layout.warp, dvec2(0.0));
  offset.metres += offset.texels * warped_texel(*layout.warp, layout.resolution, middle);
  offset.texels = 0.0;
  return offset;
}

bool is_inside(const MapLayout& layout, const dvec3& position) {
  if (is_omnidirectional(layout.kind)) return true;
  const dvec3 local = in_light_space(layout, position);
  if (layout.kind == MapKind::perspective) {
    if (!(-local.z > 0.0)) return false;
    const double half = layout.views.front().half_extent * -local.z;
    return std::abs(local.x) <= half && std::abs(local.y) <= half;
  }
  const bool is_near =
      layout.selection == CascadeSelection::map || view_depth(layout, local) <= layout.views.back().farthest;
  if (!is_near || !layout.warp) return is_near && is_on_view(layout.views[view_of(layout, local)], local);
  const dvec2 place = glm::abs(on_warped(*layout.warp, dvec2(local)));
  return local.y > layout.warp->center.y && place.x <= 1.0 && place.y <= 1.0;
}

PixelExclusion exclusion_of(const Light& light, const MapLayout& layout, const dvec3& position,
                            const dvec3& geometric_normal) {
  if (!faces(light, position, geometric_normal)) return PixelExclusion::back_facing;
  const dvec3 direction = to_light(light, position);
  if (!is_inside(layout, position)) return PixelExclusion::outside_map;
  double range = 0.0;
  if (const auto* spot = std::get_if<SpotLight>(&light.shape)) {
    // Of sine and cosine, so that narrow cones lose no digits.
    const double angle =
        std::atan2(glm::length(glm::cross(light.axis(), -direction)), glm::dot(light.axis(), -direction));
    if (angle > spot->outer_cone_angle) return PixelExclusion::outside_cone;
    range = spot->range;
  } else if (const auto* point = std::get_if<PointLight>(&light.shape)) {
    range = point->range;
  }
  if (range > 0.0 && glm::length(light.position() - position) > range) return PixelExclusion::outside_range;
  return PixelExclusion::none;
}

}  // namespace umbrameter
