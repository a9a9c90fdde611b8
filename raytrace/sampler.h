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

/// Point `index` of independent random points, as even as a hash makes them. Each coordinate is in [0, 1).
vec2 random_point(std::uint32_t index, std::uint32_t scramble);

/// The unit square onto the open unit disk, areas in proportion, squares about the middle onto circles (Shirley and
/// Chiu, A Low Distortion Map Between Disk and Square, 1997).
vec2 concentric_disk(vec2 point);

/// Directions about +Z from a point of the unit disk, z > 0. Even points give these densities.
vec3 lift_cosine(vec2 disk);   ///< cos θ / π (Malley's method: straight up)
vec3 lift_uniform(vec2 disk);  ///< 1 / 2π (Lambert's equal-area projection)

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
inline constexpr int most_randomisations = 16;
/// For a fixed number of rays: 8 randomisations, up to 16 where each keeps 128 points, fewer where one would have less
/// than 2. More make the interval's quantile smaller, but leave each with fewer of the sequence's even points.
Randomisations split(int spp);

}  // namespace umbrameter
