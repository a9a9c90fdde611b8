// A rectangle by the solid angle that it spans. For raytrace/*.cpp and tests.
#pragma once

#include "core/math.h"

namespace umbrameter {

/// Points of a rectangle that are even over its solid angle at the origin (Ureña, Fajardo and King, An Area-Preserving
/// Parametrization for Spherical Rectangles, EGSR 2013).
class SphericalRectangle {
 public:
  /// By its middle and half its sides, which are at right angles; metres.
  SphericalRectangle(const dvec3& middle, const dvec3& half_x, const dvec3& half_y);

  /// Steradians, 0 where the origin is in the rectangle's plane.
  double solid_angle() const { return solid_angle_; }

  /// Part of the solid angle by which points may be off their place through rounding; infinite where that is 0.
  double error() const;

  /// The point of the rectangle for one of the unit square, metres.
  dvec3 sample(const dvec2& point) const;

 private:
  dvec3 x_, y_, z_;  // unit; z is normal to the rectangle
  double x0_, x1_;   // sides along x and y, metres
  double y0_, y1_;
  double height_;    // of the plane along z, metres, not above 0
  double farthest_;  // corner, metres
  double solid_angle_;
  double start_;  // angle at which the sweep along x begins
  double first_;  // z of the normals to the planes through the origin and the sides at y0 and y1
  double second_;
};

}  // namespace umbrameter
