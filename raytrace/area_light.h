// Points of a light with extent, as a surfel sees them. For raytrace/*.cpp and tests.
#pragma once

#include <optional>

#include "core/math.h"
#include "raytrace/parameters.h"
#include "raytrace/spherical_rectangle.h"
#include "scenes/scene.h"

namespace umbrameter {

/// Maps the square onto itself, keeping areas: two shears modulo 1. Edges of shadows that lie along the sides of a
/// rectangle lie along the cells of a Sobol net; there all randomisations can agree on a wrong answer, and their
/// scatter tells nothing. Slanted edges cross many cells. Slants in (0, 2), different for each pixel.
vec2 slanted(vec2 point, vec2 slants);

/// A light prepared for one surfel.
class LightView {
 public:
  /// The light must have extent; `from` is where rays leave.
  LightView(const Light& light, LightSampling sampling, const dvec3& from);

  /// Nothing fits between the surfel and the light.
  bool is_within() const { return is_within_; }

  struct Sample {
    dvec3 direction;      ///< unit
    double reach = 0.0;   ///< metres to the light, infinite to a distant one
    double weight = 1.0;  ///< of this point in the share, above 0, up to a factor that all points have in common
  };
  Sample sample(vec2 point) const;

 private:
  Sample in_cone(const dvec2& disk) const;

  LightSampling sampling_;
  bool is_flat_ = false;    // disk or rectangle
  bool is_round_ = false;   // the square goes onto the disk
  bool is_within_ = false;  // inside of a sphere
  dvec3 x_{0.0};            // flat: half axes; else unit
  dvec3 y_{0.0};
  dvec3 z_{0.0};       // flat: unit normal; else unit, to the middle
  dvec3 way_{0.0};     // to the middle, metres; of a distant light a unit vector
  double radius_ = 0;  // of a sphere; 0 of a distant light
  double tangent_ = 0;
  double cap_ = 0;                               // 1 − cos of the half angle
  std::optional<SphericalRectangle> spherical_;  // what points are drawn from, where that is the solid angle
};

}  // namespace umbrameter
