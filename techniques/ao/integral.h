// What a method of ambient occlusion sets out to compute, whatever it approximates: an integral over the directions
// above a surfel, whose integrand depends on the first surface that a ray meets. Not how a method computes it.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "techniques/ao/technique.h"

namespace umbrameter {

/// How the directions of the hemisphere are weighted.
enum class AoDirections : int { cosine, uniform };

/// What blocks a ray from a surfel: a point of a surface. The ray passes through that point, or behind it as the camera
/// sees it, where all is assumed solid.
struct AoHit {
  double along_ray = 0.0;         ///< metres along the ray at which it is blocked
  double distance = 0.0;          ///< metres from the surfel to the point
  double cosine = 1.0;            ///< between the geometric normal and the direction to the point
  double above_tangent = 0.0;     ///< radians from tangent plane to ray, in the plane through ray and viewer direction
  double depth_difference = 0.0;  ///< metres along the camera's axis from the surfel to the point, not negative
  double behind = 0.0;            ///< metres along the camera's axis from the point to the ray; 0: it passes through
  double behind_to_viewer = 0.0;  ///< the same along the surfel's direction to the viewer
};

/// A method's own integral: output(1 − mean over the directions of occlusion(hit)), where a ray without a hit within
/// the reach does not occlude.
struct AoIntegral {
  AoDirections directions = AoDirections::uniform;
  double reach = 0.0;  ///< metres, of rays to points
  std::function<double(const AoHit&)> occlusion;
  std::function<double(double)> output;
  std::string formula;  ///< for people: the weight of a hit and the output
  /// What the method shows for an output at a pixel; the output itself if empty.
  std::function<double(double, std::size_t)> shown{};
  /// Metres by which a ray can be behind a point within the reach, along the surfel's direction to the viewer: rays
  /// that pass behind surfaces are followed farther than the reach by what that takes.
  double reach_behind = 0.0;
};

AoIntegral integral_of(const Ssao& technique);
AoIntegral integral_of(const Gtao& technique);
AoIntegral integral_of(const Hbao& technique);
AoIntegral integral_of(const Alchemy& technique);
AoIntegral integral_of(const Crytek& technique);
AoIntegral integral_of(const Marched& technique);
/// Nothing with weights by angle: they have no density over the hemisphere that its rays could follow.
std::optional<AoIntegral> integral_of(const Bitmask& technique);

/// Nothing for a technique whose integral is not known. Lengths are in metres: in_metres().
std::optional<AoIntegral> find_integral(const AoTechnique& technique);

/// The technique with as many samples as it takes, at full resolution and without a blur: what it converges to.
AoParams with_many_samples(AoParams params);

}  // namespace umbrameter
