// The offset of rays that leave huge triangles: one bound per point. For raytrace/surfel.cpp alone.
#pragma once

#include "raytrace/surfel.h"

namespace umbrameter {

/// Turns the description of a triangle that may be huge into that of a huge one, if it is.
void describe_huge(const Tracer& tracer, std::uint32_t instance, std::uint32_t id, SurfelTriangle& triangle);

/// RayOrigin::offset at a point of a huge triangle, metres.
double offset_at(const SurfelTriangle& huge, const dvec3& point);

}  // namespace umbrameter
