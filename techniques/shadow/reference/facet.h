// Triangles of the scene in light space, on the CPU.
#pragma once

#include "scenes/scene.h"
#include "techniques/shadow/reference/lookup.h"

namespace umbrameter {

/// A triangle in light space.
struct Facet {
  dvec3 a{0.0};
  dvec3 ab{0.0};
  dvec3 ac{0.0};
  dvec3 normal{0.0};          ///< unit, towards the light
  double vertex_error = 0.0;  ///< largest displacement of a vertex by rounding, metres
};
Facet facet_of(const Scene& scene, const MapLayout& layout, std::uint32_t instance, std::uint32_t triangle);

/// The point of a facet's plane that is nearest to a position; in light space.
dvec3 foot_on(const Facet& facet, const dvec3& position);

/// Where the light's ray intersects the facet, in light space. If the ray misses it, because rasterisation covers
/// texels slightly outside a triangle, the point is clamped to the facet's edge.
dvec3 sample_on(const Facet& facet, const TexelRay& ray);

}  // namespace umbrameter
