#include "techniques/shadow/reference/lookup.h"

#include <algorithm>
#include <cmath>

#include "techniques/shadow/map_depth.h"
#include "techniques/shadow/reference/ordered.h"

namespace umbrameter {
namespace {

// The face across the nearest edge, which is that of the second largest component; of paraboloids the other one.
int neighbour_face_of(MapKind kind, const dvec3& direction) {
  if (kind == MapKind::paraboloid) return 1 - face_of(kind, direction);
  dvec3 other = direction;
  other[face_of(kind, direction) / 2] = 0.0;
  return face_of(kind, other);
}

ivec2 floor_of(const dvec2& v) { return {static_cast<int>(std::floor(v.x)), static_cast<int>(std::floor(v.y))}; }

bool is_on_map(const ivec2& texel, int resolution) {
  return texel.x >= 0 && texel.y >= 0 && texel.x < resolution && texel.y < resolution;
}

}  // namespace

int face_of(MapKind kind, const dvec3& direction) {
  if (kind == MapKind::paraboloid) return direction.z > 0.0 ? 1 : 0;
  const dvec3 d = glm::abs(direction);
  if (d.x >= d.y && d.x >= d.z) return direction.x >= 0.0 ? 0 : 1;
  if (d.y >= d.z) return direction.y >= 0.0 ? 2 : 3;
  return direction.z >= 0.0 ? 4 : 5;
}

dvec3 on_face(MapKind kind, int face, const dvec3& p) {
  if (kind == MapKind::paraboloid) {
    const double side = face == 0 ? 1.0 : -1.0;
    return {side * p.x, p.y, length_of(p) - side * p.z};
  }
  const dmat3 basis = cube_face(face);
  return {dot_of(basis[0], p), dot_of(basis[1], p), dot_of(basis[2], p)};
}

Receiver project_to_map(const MapLayout& layout, const dvec3& world, double dither) {
  Receiver r;
  const dvec3 p = transform_point(layout.light_from_world, world);
  r.in_light = p;
  dvec2 projected(0.0);
  if (layout.kind == MapKind::orthographic) {
    r.axis_depth = r.depth = -p.z;
    r.is_inside = layout.selection == CascadeSelection::map || view_depth(layout, p) <= layout.views.back().farthest;
    r.is_inside = r.is_inside && !is_faded(layout, p, dither);
    r.view = static_cast<int>(view_of(layout, p, dither));
    const MapView& view = layout.views[static_cast<std::size_t>(r.view)];
    if (layout.warp) {
      r.is_inside = r.is_inside && p.y > layout.warp->center.y;
      if (r.is_inside) projected = on_warped(*layout.warp, dvec2(p.x, p.y));
    } else {
      projected = (dvec2(p.x, p.y) - view.center) / view.half_extent;
    }
  } else {
    dvec3 q(p.x, p.y, -p.z);
    r.depth = q.z;
    if (is_omnidirectional(layout.kind)) {
      r.view = layout.uses_neighbour ? neighbour_face_of(layout.kind, p) : face_of(layout.kind, p);
      q = on_face(layout.kind, r.view, p);
      r.depth = length_of(p);
    } else if (layout.rounds_receivers) {
      const ClipRows rows = clip_rows(layout);
      r.depth = shared::depth_in_floats(vec3(world), rows.z, rows.w, layout.encoded_near, far_end_of(layout));
    }
    r.axis_depth = q.z;
    r.is_inside = r.axis_depth > 0.0;
    if (r.is_inside) projected = dvec2(q.x, q.y) / (q.z * layout.views.front().half_extent);
  }
  const auto resolution = static_cast<double>(layout.resolution);
  r.texels = glm::clamp((projected * 0.5 + 0.5) * resolution, -2.0, resolution + 2.0);
  r.texel = floor_of(r.texels);
  if (is_omnidirectional(layout.kind)) r.texel = glm::clamp(r.texel, ivec2(0), ivec2(layout.resolution - 1));
  r.is_inside = r.is_inside && is_on_map(r.texel, layout.resolution);
  return r;
}

TexelRay texel_ray(const MapLayout& layout, const ivec2& texel, int face) {
  const MapView& view = layout.views[layout.kind == MapKind::orthographic ? static_cast<std::size_t>(face) : 0];
  const dvec2 place = (dvec2(texel) + 0.5) / static_cast<double>(layout.resolution) * 2.0 - 1.0;
  const dvec2 c = layout.warp ? from_warped(*layout.warp, place) : view.center + place * view.half_extent;
  switch (layout.kind) {
    case MapKind::orthographic:
      return {{c.x, c.y, 0.0}, {0.0, 0.0, -1.0}};
    case MapKind::perspective:
      return {dvec3(0.0), {c.x, c.y, -1.0}};
    case MapKind::paraboloid: {
      const double side = face == 0 ? 1.0 : -1.0;
      return {dvec3(0.0), {side * 2.0 * c.x, 2.0 * c.y, -side * (1.0 - (c.x * c.x + c.y * c.y))}};
    }
    case MapKind::cube:
      break;
  }
  const dmat3 basis = cube_face(face);
  return {dvec3(0.0), basis[0] * c.x + basis[1] * c.y + basis[2]};
}

std::optional<double> plane_depth(const MapLayout& layout, const Receiver& receiver, const ivec2& texel, int view) {
  const TexelRay ray = texel_ray(layout, texel, view);
  const double facing = dot_of(receiver.plane, ray.direction);
  if (!(facing < 0.0)) return std::nullopt;
  double along = dot_of(receiver.plane, receiver.in_light - ray.origin) / facing;
  if (is_omnidirectional(layout.kind)) along *= length_of(ray.direction);
  if (layout.kind != MapKind::orthographic && along <= 0.0) return std::nullopt;
  return along;
}

}  // namespace umbrameter
