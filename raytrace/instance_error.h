// The rounding error that the transform of an instance adds to rays that start on it. For raytrace/*.cpp alone.
#pragma once

#include "core/math.h"

namespace umbrameter {

/// The relative error of rounding to a float, half a unit in the last place: u in the derivations. There γ(n) is the
/// error of n roundings, n·u/(1 − n·u) (Higham, Accuracy and Stability of Numerical Algorithms, 2002, theorem 2.2,
/// lemma 3.1).
inline constexpr double half_ulp = 0x1p-24;

/// Bound on the error of a ray's origin p after its transform to the space of a shared mesh, in metres of the world:
/// the length of linear · |p| + constant.
struct OriginError {
  dmat3 linear{0.0};
  dvec3 constant{0.0};
};
OriginError origin_error(const dmat4& world_from_mesh);

/// Whether the transform scales all directions by the same factor.
bool is_similarity(const dmat4& world_from_mesh);

}  // namespace umbrameter
