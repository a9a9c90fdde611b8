// Points on the unit square and directions on the hemisphere, as functions of pixel, seed and index alone.
// For raytrace/*.cpp and tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "core/math.h"

namespace umbrameter {

/// Point `index` of the two-dimensional Sobol sequence (Sobol 1967), Owen-scrambled by hashing: every dimension's
/// digits are permuted by a nested uniform scramble (Owen 1995; Laine and Karras 2011; Burley, Practical Hash-based
/// Owen Scrambling, JCGT 9(4), 2020). Equal scrambles give equal sequences. Each coordinate is in [0, 1).
vec2 owen_sobol(std::uint32_t index, std::uint32_t scramble);

/// Point `index` of independent random points, from a hash. Each coordinate is in [0, 1).
vec2 random_point(std::uint32_t index, std::uint32_t scramble);

/// Writes the points from `begin` on to x and y, of equal size: the same points as above, but faster.
void make_points(bool is_sobol, std::uint32_t begin, std::uint32_t scramble, std::span<float> x, std::span<float> y);

/// Cosine and sine of an angle of up to 45 degrees by Taylor series, with an error below 1e-7 (3e-8 from truncation,
/// the rest from rounding). Without branches or calls, so that loops vectorise and results do not depend on the C
/// library or, without fused multiply-add, on the processor.
inline vec2 direction_near_x(float angle) {
  const float square = angle * angle;
  return {
      1.0f + square * (-1.0f / 2.0f + square * (1.0f / 24.0f + square * (-1.0f / 720.0f + square * (1.0f / 40320.0f)))),
      angle * (1.0f + square * (-1.0f / 6.0f +
                                square * (1.0f / 120.0f + square * (-1.0f / 5040.0f + square * (1.0f / 362880.0f)))))};
}

/// The point of the unit circle at this share of a full turn from +X, 0 to 1.
inline vec2 direction_at(float turn) {
  constexpr float to_nearest = 0.5f;
  const auto quarter = static_cast<int>(4.0f * turn + to_nearest);
  const vec2 near = direction_near_x(static_cast<float>(pi / 2.0) * (4.0f * turn - static_cast<float>(quarter)));
  const vec2 half = (quarter & 1) == 0 ? near : vec2(-near.y, near.x);
  return (quarter & 2) == 0 ? half : -half;
}

/// The area-preserving concentric map from the unit square to the open unit disk (Shirley and Chiu, A Low Distortion
/// Map Between Disk and Square, 1997).
inline vec2 concentric_disk(vec2 point) {
  // Scales the square so that no point is on the circle, where lifted directions would be in the plane.
  constexpr float inside = 1.0f - 0x1p-22f;
  const float px = inside * (2.0f * point.x - 1.0f);
  const float py = inside * (2.0f * point.y - 1.0f);
  const bool is_wide = std::abs(px) > std::abs(py);
  const float radius = is_wide ? px : py;
  const float part = (is_wide ? py : px) / (radius == 0.0f ? 1.0f : radius);
  const vec2 direction = direction_near_x(static_cast<float>(pi / 4.0) * part);
  const float along = radius * direction.x;
  const float across = radius * direction.y;
  return {is_wide ? along : across, is_wide ? across : along};
}

/// Directions about +Z from a point of the unit disk, z > 0, with these densities for uniform points:
/// cos θ / π (Malley's method: projection along +Z).
inline vec3 lift_cosine(vec2 disk) {
  const float squared = 1.0f - (disk.x * disk.x + disk.y * disk.y);
  return {disk.x, disk.y, std::sqrt(squared > 0x1p-24f ? squared : 0x1p-24f)};
}
/// 1 / 2π (Lambert's equal-area projection).
inline vec3 lift_uniform(vec2 disk) {
  const float squared = disk.x * disk.x + disk.y * disk.y;
  const float stretch = std::sqrt(2.0f - squared);
  const float height = 1.0f - squared;
  return {disk.x * stretch, disk.y * stretch, height > 0x1p-24f ? height : 0x1p-24f};
}

/// A right-handed frame whose third column is n (Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1),
/// 2017).
mat3 frame_about(vec3 n);

/// The division of a pixel's rays into independent randomisations.
struct Randomisations {
  int count = 1;
  int points = 1;  ///< in all
  /// Points of randomisation r: the remainder of the division goes to the first ones.
  int size(int r) const { return points / count + (r < points % count ? 1 : 0); }
};
inline constexpr int max_randomisations = 16;
/// For a fixed number of rays: 8 randomisations; up to 16 if each has at least 64 points; fewer if one would have less
/// than 2. More randomisations reduce the interval's quantile, but shorten the low-discrepancy sequence of each.
Randomisations split(int spp);

}  // namespace umbrameter
