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

/// Where a ray from a surfel meets a surface.
struct AoHit {
  double distance = 0.0;          ///< metres along the ray
  double cosine = 1.0;            ///< between ray and geometric normal
  double above_tangent = 0.0;     ///< radians from tangent plane to ray, in the plane through ray and viewer direction
  double depth_difference = 0.0;  ///< metres along the camera's axis from the surfel to the surface, not negative
};

/// A method's own integral: output(1 − mean over the directions of occlusion(hit)), where a ray without a hit within
/// the reach does not occlude.
struct AoIntegral {
  AoDirections directions = AoDirections::uniform;
  double reach = 0.0;  ///< metres
  std::function<double(const AoHit&)> occlusion;
  std::function<double(double)> output;
  /// Whether occlusion() also falls with the depth difference: then a surface behind may occlude more than one in
  /// front.
  bool fades_with_depth = false;
  std::string formula;  ///< for people: the weight of a hit and the output
};

AoIntegral integral_of(const Ssao& technique);
AoIntegral integral_of(const Gtao& technique);
AoIntegral integral_of(const Hbao& technique);
AoIntegral integral_of(const Alchemy& technique);
AoIntegral integral_of(const Crytek& technique);

/// Nothing for a technique that has no integral of its own here. Lengths are in metres: in_metres().
std::optional<AoIntegral> integral_of(const AoTechnique& technique);

/// The technique with as many samples as it takes, and without a blur: what it converges to.
AoParams with_many_samples(AoParams params);

}  // namespace umbrameter
