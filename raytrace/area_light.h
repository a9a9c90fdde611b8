// Points of a light with extent, as a surfel sees them. For raytrace/*.cpp and tests.
#pragma once

#include <optional>

#include "core/math.h"
#include "raytrace/spherical_rectangle.h"
#include "scenes/scene.h"
#include "techniques/truth/parameters.h"

namespace umbrameter {

/// Maps the unit square onto itself by two shears modulo 1, which preserve area. A shadow edge parallel to a side of a
/// rectangular light is parallel to the cells of the Sobol points: all randomisations can then agree on a wrong value,
/// without scatter. A sheared edge crosses many cells. `factors` are in (0, 2) and differ from pixel to pixel.
vec2 shear(vec2 point, vec2 factors);

/// An area light as seen from one surfel, to sample points or directions.
class LightView {
 public:
  /// The light must have extent; `from` is the origin of the rays.
  LightView(const Light& light, LightSampling sampling, const dvec3& from);

  /// Whether the surfel is inside a sphere light.
  bool is_inside() const { return is_inside_; }

  struct Sample {
    dvec3 direction;      ///< unit
    double reach = 0.0;   ///< metres to the light, infinite to a distant one
    double weight = 1.0;  ///< of this point in the visible share, above 0; up to a factor common to all points
  };
  Sample sample(vec2 point) const;

 private:
  Sample in_cone(const dvec2& disk) const;

  LightSampling sampling_;
  bool is_flat_ = false;   // disk or rectangle
  bool is_round_ = false;  // points are mapped from the square to the disk
  bool is_inside_ = false;
  dvec3 x_{0.0};  // flat: half axes; otherwise unit
  dvec3 y_{0.0};
  dvec3 z_{0.0};                                 // flat: unit normal; otherwise unit, towards the centre
  dvec3 to_center_{0.0};                         // metres; of a distant light a unit vector
  double radius_ = 0;                            // of a sphere; 0 of a distant light
  double tangent_ = 0;                           // of half the angle that it spans
  double cap_ = 0;                               // 1 − cos of half that angle
  std::optional<SphericalRectangle> spherical_;  // set if points of a rectangle are uniform in solid angle
};

}  // namespace umbrameter
