// The offset of ray origins on huge triangles, which depends on the point. For raytrace/surfel.cpp alone.
#pragma once

#include "raytrace/surfel.h"

namespace umbrameter {

/// Changes the description of a triangle if it is huge.
void describe_huge(const Tracer& tracer, std::uint32_t instance, std::uint32_t id, SurfelTriangle& triangle);

/// RayOrigin::offset at a point of a huge triangle, metres.
double offset_at(const SurfelTriangle& huge, const dvec3& point);

}  // namespace umbrameter
