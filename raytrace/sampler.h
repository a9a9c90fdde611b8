// Points on the unit square and directions on the hemisphere, as functions of pixel, seed and index alone.
// For raytrace/*.cpp and tests.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math.h"

namespace umbrameter {

/// Point `index` of the two-dimensional Sobol sequence (Sobol 1967), Owen-scrambled by hashing: every dimension's
/// digits are permuted by a nested uniform scramble (Owen 1995; Laine and Karras 2011; Burley, Practical Hash-based
/// Owen Scrambling, JCGT 9(4), 2020). Equal scrambles give equal sequences. Each coordinate is in [0, 1).
vec2 owen_sobol(std::uint32_t index, std::uint32_t scramble);

/// Directions about +Z from a point of the square. z > 0.
vec3 cosine_hemisphere(vec2 point);   ///< density cos θ / π (Malley's method: the disk, lifted)
vec3 uniform_hemisphere(vec2 point);  ///< density 1 / 2π (z is uniform: Archimedes)

/// A right-handed frame whose third column is n (Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1),
/// 2017).
mat3 frame_about(vec3 n);

/// How a pixel's rays are split into independent randomisations.
struct Randomisations {
  int count = 1;
  int points = 1;  ///< in all
  /// Points of randomisation r: the first of them hold one more where the division leaves a rest.
  int size(int r) const { return points / count + (r < points % count ? 1 : 0); }
};
Randomisations split(int spp);

}  // namespace umbrameter
