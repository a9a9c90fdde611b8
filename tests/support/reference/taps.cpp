#include "tests/support/reference/taps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "techniques/shadow/histogram.h"
#include "techniques/shadow/map_depth.h"
#include "techniques/shadow/reference/ordered.h"

namespace umbrameter {
namespace {

#define SHARED inline
#include "techniques/shadow/hardening.glsl"
#undef SHARED

ivec2 floor_of(const dvec2& v) { return {static_cast<int>(std::floor(v.x)), static_cast<int>(std::floor(v.y))}; }

bool is_on_map(const ivec2& texel, int resolution) {
  return texel.x >= 0 && texel.y >= 0 && texel.x < resolution && texel.y < resolution;
}

float texel_side(const MapLayout& layout, const Receiver& receiver) {
  if (layout.warp) {
    return static_cast<float>(warped_texel(*layout.warp, layout.resolution, dvec2(receiver.in_light)));
  }
  const std::size_t view = layout.kind == MapKind::orthographic ? static_cast<std::size_t>(receiver.view) : 0;
  double side = 2.0 * layout.views[view].half_extent / static_cast<double>(layout.resolution);
  if (layout.kind != MapKind::orthographic) side *= receiver.axis_depth;
  return static_cast<float>(side);
}

// Metres per unit of constant bias. The same operations in the same order as in light_map.glsl.
float bias_unit_of(const MapLookup& lookup, const Receiver& receiver, float texel) {
  const bool is_orthographic = lookup.layout.kind == MapKind::orthographic;
  const std::size_t view = is_orthographic ? static_cast<std::size_t>(receiver.view) : 0;
  const auto factor = static_cast<float>(bias_factor(lookup.layout.views[view], lookup.bias.constant.unit));
  switch (lookup.bias.constant.unit) {
    case LengthUnit::texels:
      return factor * texel;
    case LengthUnit::map_depth:
      return factor * static_cast<float>(metres_per_map_depth(lookup.layout, receiver.depth));
    default:
      return factor;
  }
}

double blocker_depth(const MapLookup& lookup, const Receiver& receiver, float critical_bias) {
  const auto bias = static_cast<double>(critical_bias);
  return compares_encoded(lookup.layout, lookup.bias.constant.unit)
             ? receiver.depth * receiver.depth / (receiver.depth + bias)
             : receiver.depth - bias;
}

// compared_depth() of light_map.glsl.
double compared_depth(const MapLookup& lookup, const Receiver& receiver, const ivec2& texel, int view) {
  if (!lookup.bias.receiver_plane) return receiver.depth;
  return plane_depth(lookup.layout, receiver, texel, view).value_or(receiver.depth);
}

Tap fetch_tap(const MapLookup& lookup, const Receiver& receiver, const ivec2& offset) {
  const MapLayout& layout = lookup.layout;
  const int resolution = layout.resolution;
  Tap tap;
  tap.texel = receiver.texel + offset;
  tap.view = receiver.view;
  bool is_there = is_on_map(tap.texel, resolution);
  // A paraboloid's texels outside the circle see the other hemisphere.
  if (layout.kind == MapKind::paraboloid) {
    is_there = is_there && face_of(layout.kind, texel_ray(layout, tap.texel, tap.view).direction) == tap.view;
  }
  if (is_omnidirectional(layout.kind) && !is_there) {
    const dvec3 direction = texel_ray(layout, tap.texel, tap.view).direction;
    tap.view = face_of(layout.kind, direction);
    const dvec3 q = on_face(layout.kind, tap.view, direction);
    const dvec2 texels =
        (dvec2(q.x, q.y) / (q.z * layout.views.front().half_extent) * 0.5 + 0.5) * static_cast<double>(resolution);
    tap.texel = glm::clamp(floor_of(texels), ivec2(0), ivec2(resolution - 1));
    is_there = true;
  }
  if (!receiver.is_inside || !is_there) return tap;
  const float stored = lookup.map.depth[static_cast<std::size_t>(tap.view)][texel_index(layout, tap.texel)];
  tap.has_blocker = stored < 1.0f;
  if (tap.has_blocker) {
    const double compared = compared_depth(lookup, receiver, tap.texel, tap.view);
    double blocker = static_cast<double>(stored) * layout.far_depth;
    if (layout.warp && layout.warp->stores_over_w && !lookup.bias.receiver_plane) {
      // The depth that has this texel's number at the receiver's w.
      const MapWarp& warp = *layout.warp;
      const double w = warp_w(warp, (tap.texel.y + 0.5) / static_cast<double>(resolution) * 2.0 - 1.0);
      blocker = warp.middle_depth + (blocker - warp.middle_depth) * ((receiver.in_light.y - warp.center.y) / w);
    }
    if (layout.rounds_receivers && !lookup.bias.receiver_plane) {
      blocker = shared::passing_depth(blocker, layout.equal_is_lit ? 1 : -1, layout.encoded_near, far_end_of(layout));
    }
    double above = compared - blocker;
    if (compares_encoded(layout, lookup.bias.constant.unit)) {
      const double near = layout.encoded_near;
      above *= receiver.depth * receiver.depth / (std::max(compared, near) * std::max(blocker, near));
    }
    if (lookup.bias.cone > 0.0) {
      const dvec2 away = dvec2(receiver.texel + offset) + 0.5 - receiver.texels;
      above -= static_cast<double>(static_cast<float>(lookup.bias.cone)) *
               std::sqrt(away.x * away.x + away.y * away.y) * static_cast<double>(texel_side(layout, receiver));
    }
    tap.critical_bias = static_cast<float>(above);
  }
  return tap;
}

void fetch_grid(const MapLookup& lookup, const Receiver& receiver, std::vector<Tap>& taps) {
  const FilterKernel& filter = lookup.filter;
  const int size = static_cast<int>(filter.kernel.size());
  const bool is_even = size % 2 == 0;
  ivec2 first(-(size / 2));
  std::array<std::uint32_t, 2> part{};
  if (filter.linear_taps) {
    const double half_texel = is_even ? 0.0 : 0.5;
    const dvec2 base = glm::floor(receiver.texels - half_texel);
    first += ivec2(base) - receiver.texel;
    const dvec2 parts = glm::floor((receiver.texels - half_texel - base) * double{FilterKernel::texel_parts} + 0.5);
    part = {static_cast<std::uint32_t>(parts.x), static_cast<std::uint32_t>(parts.y)};
  } else if (is_even) {
    first += floor_of(receiver.texels + 0.5) - receiver.texel;
  }
  const AxisWeights columns = axis_weights(filter, part[0]);
  const AxisWeights rows = axis_weights(filter, part[1]);
  for (int y = 0; y < filter.side(); ++y) {
    for (int x = 0; x < filter.side(); ++x) {
      Tap& tap = taps.emplace_back(fetch_tap(lookup, receiver, first + ivec2(x, y)));
      tap.weight = columns[static_cast<std::size_t>(x)] * rows[static_cast<std::size_t>(y)];
    }
  }
}

vec2 turn_of(const MapLookup& lookup, std::size_t pixel) {
  const std::vector<vec2>& rotations = lookup.filter.rotations;
  const auto width = static_cast<std::size_t>(lookup.gbuffer.width);
  const auto column = static_cast<std::uint32_t>(pixel % width);
  const auto row = static_cast<std::uint32_t>(pixel / width);
  switch (lookup.filter.rotation) {
    case DiskRotation::random:
      return rotations[hash(column, row) % rotations.size()];
    case DiskRotation::fixed:
      return rotations.front();
    case DiskRotation::gradient:
      break;
  }
  const double sum = 0.06711056 * column + 0.00583715 * row;
  const double scaled = 52.9829189 * (sum - std::floor(sum));
  const double noise = (scaled - std::floor(scaled)) * static_cast<double>(rotations.size());
  return rotations[std::min(static_cast<std::size_t>(noise), rotations.size() - 1)];
}

ivec2 disk_offset(const Receiver& receiver, const vec2& p, const vec2& turn, float radius) {
  const vec2 turned(turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y);
  const dvec2 texels = receiver.texels + dvec2(turned) * static_cast<double>(radius);
  return floor_of(texels) - receiver.texel;
}

bool is_lit(const MapLookup& lookup, const SurfelLookup& surfel, const Tap& tap) {
  const float flip = flip_bias(tap.critical_bias, surfel.slope, static_cast<float>(lookup.bias.slope));
  return is_lit_at(static_cast<float>(lookup.bias.constant.number), surfel.bias_unit, flip);
}

// As the shader function of the same name, for a light of this extent.
double penumbra_at(const MapLookup& lookup, const Receiver& receiver, float extent, double blocker) {
  const double radius = static_cast<double>(extent) * (receiver.depth - blocker);
  return lookup.layout.kind == MapKind::orthographic ? radius : radius / blocker;
}

// search_radius() of shadow_filter.glsl.
float search_radius(const MapLookup& lookup, const SurfelLookup& surfel, const vec2& turn) {
  const BlockerSearch& search = *lookup.filter.search;
  const Receiver& receiver = surfel.receiver;
  const bool is_orthographic = lookup.layout.kind == MapKind::orthographic;
  const auto penumbra_at = [&](double blocker) {
    return umbrameter::penumbra_at(lookup, receiver, search.extent, blocker);
  };
  const auto texel = static_cast<double>(texel_side(lookup.layout, receiver));
  double reach = static_cast<double>(search.max_radius);
  if (is_orthographic) reach = std::min(reach, penumbra_at(0.0) / texel);
  double sum = 0.0;
  int count = 0;
  for (const vec2& p : search.points) {
    const Tap tap = fetch_tap(lookup, receiver, disk_offset(receiver, p, turn, static_cast<float>(reach)));
    if (!tap.has_blocker || is_lit(lookup, surfel, tap)) continue;
    const double blocker = blocker_depth(lookup, receiver, tap.critical_bias);
    if (!(blocker > 0.0)) continue;
    const dvec2 at(p);
    const double away = std::sqrt(at.x * at.x + at.y * at.y) * reach * texel;
    if (search.is_in_cone && away > penumbra_at(blocker)) continue;
    sum += blocker;
    ++count;
  }
  if (count == 0) return search.min_radius;
  const double radius = penumbra_at(sum / count) / texel;
  return std::clamp(static_cast<float>(radius), search.min_radius, search.max_radius);
}

// light_radius() of shadow_filter.glsl.
float light_radius(const MapLookup& lookup, const Receiver& receiver) {
  const ContactHardening& hardening = *lookup.filter.hardening;
  const double radius = lookup.layout.kind == MapKind::orthographic
                            ? penumbra_at(lookup, receiver, hardening.extent, 0.0)
                            : static_cast<double>(hardening.extent);
  return static_cast<float>(std::min(static_cast<double>(hardening.max_radius),
                                     radius / static_cast<double>(texel_side(lookup.layout, receiver))));
}

float disk_radius(const MapLookup& lookup, const SurfelLookup& surfel, const vec2& turn) {
  if (lookup.filter.hardening) return light_radius(lookup, surfel.receiver);
  return lookup.filter.search ? search_radius(lookup, surfel, turn) : lookup.filter.radius;
}

// hardened_visibility() of shadow_filter.glsl.
float hardened_visibility(const MapLookup& lookup, const SurfelLookup& surfel, const std::vector<Tap>& taps) {
  const Receiver& receiver = surfel.receiver;
  double sum = 0.0;
  int count = 0;
  for (const Tap& tap : taps) {
    if (is_lit(lookup, surfel, tap)) continue;
    sum += blocker_depth(lookup, receiver, tap.critical_bias);
    ++count;
  }
  if (count == 0) return 1.0f;
  const double mean = sum / count;
  const double disk =
      static_cast<double>(light_radius(lookup, receiver)) * static_cast<double>(texel_side(lookup.layout, receiver));
  const double softness =
      mean > 0.0 && disk > 0.0
          ? std::clamp(penumbra_at(lookup, receiver, lookup.filter.hardening->extent, mean) / disk, 0.0, 1.0)
          : 1.0;
  return 1.0f - static_cast<float>(hardened(count / static_cast<double>(taps.size()), softness));
}

void fetch_disk(const MapLookup& lookup, const SurfelLookup& surfel, std::size_t pixel, std::vector<Tap>& taps) {
  const FilterKernel& filter = lookup.filter;
  const vec2 turn = turn_of(lookup, pixel);
  const float radius = disk_radius(lookup, surfel, turn);
  for (const vec2& p : filter.points) {
    taps.emplace_back(fetch_tap(lookup, surfel.receiver, disk_offset(surfel.receiver, p, turn, radius))).weight = 1;
  }
}

}  // namespace

AxisWeights axis_weights(const FilterKernel& filter, std::uint32_t part) {
  const std::vector<std::uint32_t> sums = running_sums(filter.kernel);
  const auto size = static_cast<std::uint32_t>(filter.kernel.size());
  // weight_left_of() of shadow_filter.glsl.
  const auto weight_left_of = [&](std::uint32_t i) {
    constexpr std::uint32_t parts = FilterKernel::texel_parts;
    if (filter.is_area_tent) return area_tent_part(size, std::min(std::max(i * parts, part) - part, size * parts));
    if (!filter.linear_taps) return sums[i];
    const std::uint32_t sum = sums[std::min(i, size)] * (parts - part) + sums[std::max(i, 1u) - 1] * part;
    return (sum + filter.divisor / 2) / filter.divisor;
  };
  AxisWeights weights{};
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(filter.side()); ++i) {
    weights[i] = weight_left_of(i + 1) - weight_left_of(i);
  }
  return weights;
}

std::uint32_t area_tent_part(std::uint32_t size, std::uint32_t x) {
  const std::uint32_t width = size * FilterKernel::texel_parts;
  const std::uint32_t twice_area = width * width / 2;  // of the tent whose slope is 1
  const std::uint32_t right = width - x;
  const std::uint32_t part = 2 * x <= width ? x * x : twice_area - right * right;
  return (part * FilterKernel::area_sum + twice_area / 2) / twice_area;
}

SurfelLookup look_up(const MapLookup& lookup, std::size_t pixel) {
  SurfelLookup result;
  const dvec3 position(lookup.gbuffer.position[pixel]);
  const dvec3 normal(lookup.gbuffer.geometric_normal[pixel]);
  const dvec4 place = homogeneous_position(lookup.light);
  const dvec3 to_light = place.w == 0.0 ? dvec3(place) : dvec3(place) - position;
  const double cosine = dot_of(normal, to_light);
  result.faces_light = cosine > 0.0;
  const auto width = static_cast<std::size_t>(lookup.gbuffer.width);
  const double dither = dither_at(static_cast<std::uint32_t>(pixel % width), static_cast<std::uint32_t>(pixel / width));
  result.receiver = project_to_map(lookup.layout, position, dither);
  const double sine = length_of(cross_of(normal, to_light));
  const float texel = texel_side(lookup.layout, result.receiver);
  result.slope = texel * static_cast<float>(sine / cosine);
  const NormalOffset offset = placed_offset(lookup.layout, lookup.bias.normal_offset, lookup.bias.offset_texel);
  if (!is_none(offset)) {
    const double distance = length_of(to_light);
    const double scale = offset.profile == OffsetProfile::sine       ? sine / distance
                         : offset.profile == OffsetProfile::constant ? 1.0
                         : offset.profile == OffsetProfile::eevee    ? sine / distance + eevee_share
                                                                     : 1.0 - std::max(cosine / distance, 0.0);
    const double texels = static_cast<float>(offset.texels);
    dvec3 direction = normal;
    if (lookup.bias.offset_direction == OffsetDirection::across)
      direction -= to_light * (cosine / (distance * distance));
    const dvec3 moved = position + direction * ((texels * static_cast<double>(texel) + offset.metres) * scale);
    result.receiver = project_to_map(lookup.layout, moved, dither);
  }
  result.bias_unit = bias_unit_of(lookup, result.receiver, texel);
  result.receiver.plane = transform_vector(lookup.layout.light_from_world, normal);
  return result;
}

void fetch_taps(const MapLookup& lookup, const SurfelLookup& surfel, std::size_t pixel, std::vector<Tap>& taps) {
  taps.clear();
  if (lookup.filter.is_grid()) {
    fetch_grid(lookup, surfel.receiver, taps);
  } else {
    fetch_disk(lookup, surfel, pixel, taps);
  }
}

float visibility_of(const MapLookup& lookup, const SurfelLookup& surfel, const std::vector<Tap>& taps) {
  if (lookup.filter.hardening) return hardened_visibility(lookup, surfel, taps);
  std::uint32_t lit = 0;
  for (const Tap& tap : taps) lit += is_lit(lookup, surfel, tap) ? tap.weight : 0;
  return static_cast<float>(static_cast<double>(lit) / lookup.filter.weight_sum());
}

}  // namespace umbrameter
