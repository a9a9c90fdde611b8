#include "raytrace/huge_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "raytrace/tracer_state.h"

namespace umbrameter {
namespace {

HugeGeometry& geometry_of(void* user) { return *static_cast<HugeGeometry*>(user); }

// The bounds are rounded outwards, so that the box contains the triangle.
float below(double value) { return std::nextafter(static_cast<float>(value), -std::numeric_limits<float>::infinity()); }
float above(double value) { return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity()); }

void find_bounds(const RTCBoundsFunctionArguments* arguments) {
  const HugeTriangle& triangle = geometry_of(arguments->geometryUserPtr).triangles[arguments->primID];
  const auto& [a, b, c] = triangle.corners;
  const dvec3 low = glm::min(glm::min(a, b), c);
  const dvec3 high = glm::max(glm::max(a, b), c);
  RTCBounds& bounds = *arguments->bounds_o;
  bounds.lower_x = below(low.x);
  bounds.lower_y = below(low.y);
  bounds.lower_z = below(low.z);
  bounds.upper_x = above(high.x);
  bounds.upper_y = above(high.y);
  bounds.upper_z = above(high.z);
}

// Calls use(lane, hit, instance, triangle) for each active ray that hits the triangle.
template <class Arguments, class Use>
void for_each_hit(const Arguments& arguments, RTCRayN* rays, const Use& use) {
  const HugeGeometry& geometry = geometry_of(arguments.geometryUserPtr);
  const HugeTriangle& triangle = geometry.triangles[arguments.primID];
  const auto& query = *reinterpret_cast<const RayQuery*>(arguments.context);
  const std::uint32_t instance = instance_of(arguments.context->instID[0], geometry.instance);
  const unsigned n = arguments.N;
  for (unsigned i = 0; i < n; ++i) {
    if (arguments.valid[i] == 0 || is_ignored(query, RTCRayN_id(rays, n, i), instance, triangle.id)) continue;
    const dvec3 origin(RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i));
    const dvec3 direction(RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i));
    const std::optional<HugeHit> hit = intersect_line(triangle, origin, direction);
    if (!hit || !(hit->distance > static_cast<double>(RTCRayN_tnear(rays, n, i)))) continue;
    if (hit->distance > static_cast<double>(RTCRayN_tfar(rays, n, i))) continue;
    if (geometry.mask != nullptr && !geometry.mask->is_opaque(triangle.id, vec2(hit->weights))) continue;
    use(i, *hit, instance, triangle.id);
  }
}

void occlude(const RTCOccludedFunctionNArguments* arguments) {
  for_each_hit(*arguments, arguments->ray, [&](unsigned i, const HugeHit&, std::uint32_t, std::uint32_t) {
    RTCRayN_tfar(arguments->ray, arguments->N, i) = -std::numeric_limits<float>::infinity();
  });
}

void intersect(const RTCIntersectFunctionNArguments* arguments) {
  const unsigned n = arguments->N;
  RTCRayN* const rays = RTCRayHitN_RayN(arguments->rayhit, n);
  RTCHitN* const hits = RTCRayHitN_HitN(arguments->rayhit, n);
  for_each_hit(*arguments, rays, [&](unsigned i, const HugeHit& hit, std::uint32_t instance, std::uint32_t triangle) {
    RTCRayN_tfar(rays, n, i) = static_cast<float>(hit.distance);
    RTCHitN_u(hits, n, i) = static_cast<float>(hit.weights.x);
    RTCHitN_v(hits, n, i) = static_cast<float>(hit.weights.y);
    RTCHitN_geomID(hits, n, i) = instance;
    RTCHitN_primID(hits, n, i) = triangle;
    RTCHitN_instID(hits, n, i, 0) = arguments->context->instID[0];
  });
}

}  // namespace

bool HugeGeometry::has(std::uint32_t triangle) const {
  return std::binary_search(triangles.begin(), triangles.end(), HugeTriangle{triangle},
                            [](const HugeTriangle& a, const HugeTriangle& b) { return a.id < b.id; });
}

void set_huge_triangles(RTCGeometry geometry, HugeGeometry& huge) {
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(huge.triangles.size()));
  rtcSetGeometryUserData(geometry, &huge);
  rtcSetGeometryBoundsFunction(geometry, find_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect);
  rtcSetGeometryOccludedFunction(geometry, occlude);
}

}  // namespace umbrameter
