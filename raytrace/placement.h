// What an instance's place in the world does to the errors of the rays that start on it. For raytrace/*.cpp alone.
#pragma once

#include "core/math.h"

namespace umbrameter {

/// Half a unit in the last place of a float: the relative error of one rounding, u in the derivations, where γ(n), that
/// of n roundings, is n·u/(1 − n·u) (Higham, Accuracy and Stability of Numerical Algorithms, 2002, theorem 2.2,
/// lemma 3.1).
inline constexpr double half_ulp = 0x1p-24;

/// How far the origin of a ray at p may be off in the space of a shared mesh, seen from the world: the length of
/// linear · |p| + constant, metres.
struct OriginError {
  dmat3 linear{0.0};
  dvec3 constant{0.0};
};
OriginError origin_error(const dmat4& world_from_mesh);

/// Whether lengths of one direction in a mesh are lengths of every direction in the world times one factor.
bool is_similarity(const dmat4& world_from_mesh);

}  // namespace umbrameter
