// Uniform sampling of the solid angle of a rectangle. For raytrace/*.cpp and tests.
#pragma once

#include "core/math.h"

namespace umbrameter {

/// Samples points of a rectangle uniformly over its solid angle at the origin (Ureña, Fajardo and King, An
/// Area-Preserving Parametrization for Spherical Rectangles, EGSR 2013).
class SphericalRectangle {
 public:
  /// The rectangle is given by its centre and half its sides, which are perpendicular; metres.
  SphericalRectangle(const dvec3& middle, const dvec3& half_x, const dvec3& half_y);

  /// Steradians, 0 where the origin is in the rectangle's plane.
  double solid_angle() const { return solid_angle_; }

  /// Rounding error of the points' position, as a share of the solid angle; infinite if that is 0.
  double error() const;

  /// The point of the rectangle for one of the unit square, metres.
  dvec3 sample(const dvec2& point) const;

 private:
  dvec3 x_, y_, z_;  // unit; z is normal to the rectangle
  double x0_, x1_;   // sides along x and y, metres
  double y0_, y1_;
  double height_;    // of the plane along z, metres, not above 0
  double farthest_;  // distance of the farthest corner, metres
  double solid_angle_;
  double start_;      // azimuth at which the sweep along x begins
  double normal_z0_;  // z of the normals to the planes through the origin and the sides at y0 and y1
  double normal_z1_;
};

}  // namespace umbrameter
