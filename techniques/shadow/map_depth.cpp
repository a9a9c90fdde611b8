#include "techniques/shadow/map_depth.h"

#include <array>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>
#include <string_view>

#include "core/error.h"

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 5> depth_format_names{"32f", "16f", "16f-down", "24", "16"};
constexpr std::array<std::string_view, 3> encoding_names{"linear", "perspective", "reversed"};
constexpr std::array<std::string_view, 2> precision_names{"full", "single"};
constexpr std::array<std::string_view, 2> comparison_names{"less-equal", "less"};
constexpr std::array<std::string_view, 3> face_names{"all", "front", "back"};
constexpr std::array<std::string_view, 2> point_map_names{"cube", "paraboloid"};
constexpr std::array<std::string_view, 4> surface_names{"nearest", "midpoint", "second", "dual"};

bool is_perspective(int mapping) {
  return mapping == shared::DEPTH_PERSPECTIVE || mapping == shared::DEPTH_REVERSED_PERSPECTIVE;
}

double step_of_float(double stored, int digits, int min_exponent) {
  return std::ldexp(1.0, std::max(std::ilogb(stored) + 1, min_exponent) - digits);
}

// The difference between neighbouring numbers of the format.
double step_of_stored(MapDepthFormat format, double stored) {
  switch (format) {
    case MapDepthFormat::fixed16:
      return 1.0 / 65535.0;
    case MapDepthFormat::fixed24:
      return 1.0 / 16777215.0;
    case MapDepthFormat::f16:
    case MapDepthFormat::f16_down:
      return step_of_float(stored, 11, -13);
    case MapDepthFormat::f32:
      break;
  }
  return step_of_float(stored, std::numeric_limits<float>::digits, std::numeric_limits<float>::min_exponent);
}

}  // namespace

Parameters describe(MapDepthParams& params) {
  return Description("shadow")
      .choice("depth-format", params.format, depth_format_names,
              {.unit = {},
               .meaning =
                   "format of the shadow map: 32- or 16-bit float (16f-down: rounded down), 24- or 16-bit fixed point"})
      .choice("depth-encoding", params.encoding, encoding_names,
              {.unit = {}, .meaning = "depth that the map stores: linear, of a projection matrix, or that reversed"})
      .field("depth-near", params.near_depth,
             {.unit = "m",
              .meaning = "near plane of spot and point lights with a perspective or reversed encoding",
              .min = 1e-6})
      .field("depth-far", params.far_depth,
             {.unit = "m", .meaning = "far plane of perspective encodings; 0: the farthest surface", .min = 0})
      .choice(
          "receiver-precision", params.receiver_precision, precision_names,
          {.unit = {},
           .meaning = "precision of receivers' depths in a spot light's perspective encoding; single: as in engines"})
      .choice(
          "depth-comparison", params.comparison, comparison_names,
          {.unit = {},
           .meaning =
               "with receivers in single precision: a receiver is lit whose depth has this relation to the stored one"})
      .choice("faces", params.faces, face_names, {.unit = {}, .meaning = "faces that cast, seen from the light"})
      .choice("surface", params.surface, surface_names,
              {.unit = {}, .meaning = "surface whose depth the map holds, of the first two that the light meets"})
      .field(
          "dual-offset", params.dual_offset,
          {.unit = "m", .meaning = "dual: how far behind the nearest surface the stored depth lies at most", .min = 0})
      .field("polygon-offset-factor", params.polygon_offset_factor,
             {.unit = "1", .meaning = "hardware polygon offset: this number times the depth's slope per texel"})
      .field("polygon-offset-units", params.polygon_offset_units,
             {.unit = "units",
              .meaning = "hardware polygon offset: this number times the unit of the map's format, which is measured"})
      .field("caster-offset", params.caster_offset.texels,
             {.unit = "texels", .meaning = "moves the vertices of casters against their normals, times the profile"})
      .field("caster-offset-metres", params.caster_offset.metres,
             {.unit = "m", .meaning = "the same in metres; added to that in texels"})
      .choice("caster-offset-profile", params.caster_offset.profile, offset_profile_names,
              {.unit = {}, .meaning = "factor of the casters' offset: sin θ, 1, 1 − cos θ or sin θ + 0.168"})
      .choice("point-map", params.point_map, point_map_names,
              {.unit = {}, .meaning = "map of a point light: six cube faces or two paraboloids"})
      .field("cube-passes", params.cube_passes,
             {.unit = {}, .meaning = "draw a cube map in six passes instead of one; the map is the same"})
      .take();
}

Parameters read_parameters(MapDepthParams& params) {
  Parameters read = describe(params);
  std::erase_if(read, [&](const Parameter& each) {
    const bool is_divided = params.encoding == DepthEncoding::perspective;
    const bool is_rounded = is_divided && params.receiver_precision == ReceiverPrecision::single;
    return (each.key == "shadow.depth-near" && params.encoding == DepthEncoding::linear) ||
           (each.key == "shadow.depth-far" && params.encoding == DepthEncoding::linear) ||
           (each.key == "shadow.receiver-precision" && !is_divided) ||
           (each.key == "shadow.depth-comparison" && !is_rounded) ||
           (each.key == "shadow.dual-offset" && params.surface != StoredSurface::dual);
  });
  return read;
}

MapLayout with_point_map(MapLayout layout, PointMap point_map) {
  if (layout.kind == MapKind::cube && point_map == PointMap::paraboloid) {
    layout.kind = MapKind::paraboloid;
    layout.views.assign(2, MapView{});
  }
  return layout;
}

int depth_mapping(const MapDepthParams& params, const MapLayout& layout) {
  const bool is_reversed = params.encoding == DepthEncoding::reversed;
  if (params.encoding != DepthEncoding::linear && layout.warp) {
    return is_reversed ? shared::DEPTH_REVERSED_OVER_W : shared::DEPTH_OVER_W;
  }
  if (params.encoding == DepthEncoding::linear || !is_projective(layout.kind)) {
    return is_reversed ? shared::DEPTH_REVERSED_LINEAR : shared::DEPTH_LINEAR;
  }
  return is_reversed ? shared::DEPTH_REVERSED_PERSPECTIVE : shared::DEPTH_PERSPECTIVE;
}

MapLayout with_depth_encoding(MapLayout layout, const MapDepthParams& params) {
  const bool is_encoded = is_perspective(depth_mapping(params, layout));
  layout.encoded_near = is_encoded ? params.near_depth : 0.0;
  layout.encoded_far = is_encoded ? params.far_depth : 0.0;
  layout.equal_is_lit = params.comparison == DepthComparison::less_equal;
  layout.rounds_receivers = params.receiver_precision == ReceiverPrecision::single &&
                            layout.kind == MapKind::perspective && params.encoding == DepthEncoding::perspective;
  if (layout.warp) layout.warp->stores_over_w = params.encoding != DepthEncoding::linear;
  return layout;
}

ClipRows clip_rows(const MapLayout& layout) {
  const dvec4 depth = -glm::row(layout.light_from_world, 2);
  const double far = far_end_of(layout);
  const double scale = far / (far - layout.encoded_near);
  return {vec4(scale * (depth - dvec4(0.0, 0.0, 0.0, layout.encoded_near))), vec4(depth)};
}

bool stores_linear_floats(const MapDepthParams& params, const MapLayout& layout) {
  return params.format == MapDepthFormat::f32 && depth_mapping(params, layout) == shared::DEPTH_LINEAR;
}

bool has_polygon_offset(const MapDepthParams& params) {
  return params.polygon_offset_factor != 0.0 || params.polygon_offset_units != 0.0;
}

double depth_step(const MapDepthParams& params, const MapLayout& layout, double depth) {
  const int mapping = depth_mapping(params, layout);
  const MapLayout encoded = with_depth_encoding(layout, params);
  if (encoded.warp && encoded.warp->stores_over_w) {
    const MapWarp& warp = *encoded.warp;
    const double w = warp_w(warp, 0.0);
    const double over_w = shared::encode_over_w(mapping, depth, w, {warp.middle_depth, warp.depth_scale});
    return step_of_stored(params.format, over_w) * w / warp.depth_scale;
  }
  const double stored = shared::encode_depth(mapping, depth, params.near_depth, far_end_of(encoded));
  return step_of_stored(params.format, stored) * metres_per_map_depth(encoded, std::max(depth, encoded.encoded_near));
}

void require_sense(const MapDepthParams& params, const MapLayout& layout) {
  if (is_perspective(depth_mapping(params, layout)) && !(params.near_depth < layout.far_depth)) {
    throw Error(ExitCode::usage, "shadow.depth-near",
                to_string(Value(params.near_depth)) + " m is beyond the farthest surface, at " +
                    to_string(Value(layout.far_depth)) + " m",
                "choose a smaller one");
  }
  if (is_perspective(depth_mapping(params, layout)) && params.far_depth > 0.0 &&
      !(params.near_depth < params.far_depth)) {
    throw Error(ExitCode::usage, "shadow.depth-far",
                to_string(Value(params.far_depth)) + " m is not beyond shadow.depth-near, " +
                    to_string(Value(params.near_depth)) + " m",
                "choose a larger one, or 0");
  }
  if (params.surface != StoredSurface::nearest && has_polygon_offset(params)) {
    throw Error(ExitCode::usage, "shadow.surface",
                "a polygon offset moves a drawn surface, and this depth is computed from two of them",
                "use the nearest surface, or no polygon offset");
  }
}

}  // namespace umbrameter
