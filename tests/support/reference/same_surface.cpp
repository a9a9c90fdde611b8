#include "tests/support/reference/same_surface.h"

#include <cmath>

#include "techniques/shadow/reference/facet.h"
#include "techniques/shadow/reference/ordered.h"

namespace umbrameter {
namespace {

double signed_distance(const Facet& f, const dvec3& point) { return dot_of(f.normal, point - f.a); }

double rounding_bound(const Facet& f, const dvec3& point, double point_error) {
  const dvec3 n = cross_of(f.ab, f.ac);
  const double squared = dot_of(n, n);
  if (!(squared > 0.0)) return point_error;
  const double v = dot_of(cross_of(point - f.a, f.ac), n) / squared;
  const double w = dot_of(cross_of(f.ab, point - f.a), n) / squared;
  return point_error + f.vertex_error * (std::abs(1.0 - v - w) + std::abs(v) + std::abs(w));
}

// `own` is the receiver's facet, `blocker` the facet of the tap's sample.
bool is_same_surface(const MapLayout& layout, const Receiver& receiver, const Facet& own, const Tap& tap,
                     const Facet& blocker) {
  const dvec3 r = foot_on(own, receiver.in_light);
  if (signed_distance(blocker, r) >= -rounding_bound(blocker, r, own.vertex_error)) return true;
  const dvec3 s = sample_on(blocker, texel_ray(layout, tap.texel, tap.view));
  return signed_distance(own, s) <= rounding_bound(own, s, blocker.vertex_error);
}

}  // namespace

bool is_other_surface(const Scene& scene, const MapLookup& lookup, const Tap& tap, const Receiver& receiver,
                      std::size_t pixel, bool is_lit_in_truth) {
  if (!tap.has_blocker || !(is_lit_in_truth || tap.critical_bias > 0.0f)) return false;
  const MapLayout& layout = lookup.layout;
  const GBuffer& gbuffer = lookup.gbuffer;
  const auto face = static_cast<std::size_t>(tap.view);
  const std::size_t texel = texel_index(layout, tap.texel);
  const std::uint32_t instance = lookup.map.instance[face][texel];
  const std::uint32_t triangle = lookup.map.triangle[face][texel];
  if (instance == gbuffer.instance[pixel] && triangle == gbuffer.triangle[pixel]) return false;
  return !is_same_surface(layout, receiver, facet_of(scene, layout, gbuffer.instance[pixel], gbuffer.triangle[pixel]),
                          tap, facet_of(scene, layout, instance, triangle));
}

}  // namespace umbrameter
