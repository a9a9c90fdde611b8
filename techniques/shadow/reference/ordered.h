// Sums and products in the order of raster/shaders/arithmetic.glsl. Include this only in modules whose compiler options
// forbid contraction to fused multiply-adds.
#pragma once

#include <cmath>

#include "core/math.h"

namespace umbrameter {

inline double dot_of(const dvec3& a, const dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline dvec3 cross_of(const dvec3& a, const dvec3& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}

inline double length_of(const dvec3& a) { return std::sqrt(dot_of(a, a)); }

inline dvec3 transform_vector(const dmat4& m, const dvec3& v) {
  return dvec3(m[0]) * v.x + dvec3(m[1]) * v.y + dvec3(m[2]) * v.z;
}

inline dvec3 transform_point(const dmat4& m, const dvec3& p) { return transform_vector(m, p) + dvec3(m[3]); }

}  // namespace umbrameter
