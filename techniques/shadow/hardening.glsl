// How contact-hardening PCF sharpens a penumbra. The shaders compile this text as GLSL, the tests as C++.

/// The share of a kernel that is blocked, sharpened: softness 1 leaves it, 0 pulls it to 0 or 1 by the odd cubic
/// y (3 − 3 |y| + y²) of y = 2 blocked − 1.
SHARED double hardened(double blocked, double softness) {
  double y = 2.0 * blocked - 1.0;
  double magnitude = y < 0.0 ? -y : y;
  double hard = 0.5 + 0.5 * y * (3.0 - 3.0 * magnitude + y * y);
  return hard + softness * (blocked - hard);
}
