// Colours between linear RGB with the primaries and the white point of sRGB and the spaces in which differences are
// measured: CIE XYZ, CIELAB, YCxCz, and sRGB code values. XYZ is scaled so that white has Y = 1.
#pragma once

#include <cmath>

#include "core/math.h"

namespace umbrameter {

/// XYZ from linear RGB: from the chromaticities of ITU-R BT.709 and the white point (.31271, .32902), D65. As shares of
/// integers: Lindbloom's derivation with these inputs, as image-engineering.de (technote 958) publishes it.
inline const dmat3 xyz_from_rgb =
    glm::transpose(dmat3{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0,    // X
                         2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0,      // Y
                         1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0});  // Z
inline const dmat3 rgb_from_xyz = glm::inverse(xyz_from_rgb);
/// XYZ of white, RGB (1, 1, 1).
inline const dvec3 xyz_white = xyz_from_rgb * dvec3(1.0);

/// The sRGB code value, 0 to 1, of a linear value, and the reverse (IEC 61966-2-1).
inline double srgb_from_linear(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}
inline double linear_from_srgb(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

/// Luminance of linear RGB (ITU-R BT.709).
inline double luminance(const vec3& rgb) { return glm::dot(dvec3(0.2126, 0.7152, 0.0722), dvec3(rgb)); }

/// The linear opponent space of Zhang and Wandell, A spatial extension of CIELAB for digital color-image reproduction,
/// 1997: lightness without its cube root, red against green, yellow against blue.
inline dvec3 ycxcz_from_rgb(const dvec3& rgb) {
  const dvec3 xyz = xyz_from_rgb * rgb / xyz_white;
  return {116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z)};
}
inline dvec3 rgb_from_ycxcz(const dvec3& color) {
  const double y = (color.x + 16.0) / 116.0;
  return rgb_from_xyz * (dvec3(y + color.y / 500.0, y, y - color.z / 200.0) * xyz_white);
}

/// CIE 1976 L*a*b*.
inline dvec3 lab_from_rgb(const dvec3& rgb) {
  constexpr double delta = 6.0 / 29.0;
  const auto f = [](double t) {
    return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
  };
  const dvec3 xyz = xyz_from_rgb * rgb / xyz_white;
  const dvec3 root(f(xyz.x), f(xyz.y), f(xyz.z));
  return {116.0 * root.y - 16.0, 500.0 * (root.x - root.y), 200.0 * (root.y - root.z)};
}

}  // namespace umbrameter
