// What a shadow map stores for a depth, and back. The shaders compile this text as GLSL, and map_depth.h compiles it as
// C++. The constants of the mapping are those of map_depth.h. Depths, near_depth and far_depth are in metres; far_depth is
// MapLayout's for linear mappings, and that of far_end_of() for the others.

/// The stored number of a depth, from 0 to 1. A depth before the near plane counts as on it.
SHARED double encode_depth(int mapping, double depth, double near_depth, double far_depth) {
  if (mapping == DEPTH_LINEAR) return depth / far_depth;
  if (mapping == DEPTH_REVERSED_LINEAR) return (far_depth - depth) / far_depth;
  double z = max(depth, near_depth);
  // Each difference on its own, so that numbers near 0 keep their digits.
  if (mapping == DEPTH_PERSPECTIVE) return far_depth * (z - near_depth) / (z * (far_depth - near_depth));
  return near_depth * (far_depth - z) / (z * (far_depth - near_depth));
}

/// The same of a warped map, whose matrix divides the depth by w: MapWarp of map_warp.h. warp_depths: its middle_depth
/// and depth_scale.
SHARED double encode_over_w(int mapping, double depth, double w, dvec2 warp_depths) {
  double from_middle = warp_depths.y * (depth - warp_depths.x) / w;
  return mapping == DEPTH_REVERSED_OVER_W ? 0.5 - from_middle : 0.5 + from_middle;
}

SHARED double decode_over_w(int mapping, double stored, double w, dvec2 warp_depths) {
  double from_middle = mapping == DEPTH_REVERSED_OVER_W ? 0.5 - stored : stored - 0.5;
  return warp_depths.x + from_middle * w / warp_depths.y;
}

/// The binary exponent of the last digit of a number from 0 to 1 as a 16-bit float: 11 significant digits, none below 2^-24.
SHARED int last_digit_of_half(float stored) {
  int exponent;
  frexp(stored, exponent);
  return max(exponent, -13) - 11;
}

/// The nearest 16-bit float of a number from 0 to 1, ties to even.
SHARED float nearest_half(float stored) {
  int last_digit = last_digit_of_half(stored);
  return ldexp(roundEven(ldexp(stored, -last_digit)), last_digit);
}

/// The largest 16-bit float that is not above the number.
SHARED float half_below(float stored) {
  int last_digit = last_digit_of_half(stored);
  return ldexp(floor(ldexp(stored, -last_digit)), last_digit);
}

/// The depth of a stored number.
SHARED double decode_depth(int mapping, double stored, double near_depth, double far_depth) {
  if (mapping == DEPTH_LINEAR) return stored * far_depth;
  if (mapping == DEPTH_REVERSED_LINEAR) return far_depth - stored * far_depth;
  double across = stored * (far_depth - near_depth);
  if (mapping == DEPTH_PERSPECTIVE) return near_depth * far_depth / (far_depth - across);
  return near_depth * far_depth / (near_depth + across);
}

/// The depth of a position that is multiplied by a matrix and divided by w in 32-bit floats. z_row and w_row: the last two
/// rows of the matrix, whose depth is the number that DEPTH_PERSPECTIVE stores.
SHARED double depth_in_floats(vec3 p, vec4 z_row, vec4 w_row, double near_depth, double far_depth) {
  PRECISE float z = z_row.x * p.x + z_row.y * p.y + z_row.z * p.z + z_row.w;
  PRECISE float w = w_row.x * p.x + w_row.y * p.y + w_row.z * p.z + w_row.w;
  // The nearest float, as not every device divides floats so.
  float stored = float(double(z) / double(w));
  return decode_depth(DEPTH_PERSPECTIVE, double(stored), near_depth, far_depth);
}

/// Of a stored depth, the one up to which depth_in_floats() passes: half a step of the number before it if only a smaller
/// number is lit, which tie_shift -1 says, and half a step behind it if an equal one is lit, too, which 1 says. The depth
/// is that of a 32-bit number, rounded so little that beyond a few near planes the number is found again.
SHARED double passing_depth(double depth, int tie_shift, double near_depth, double far_depth) {
  float stored = float(encode_depth(DEPTH_PERSPECTIVE, depth, near_depth, far_depth));
  uint bits = floatBitsToUint(stored);
  float beside = uintBitsToFloat(tie_shift < 0 ? max(bits, 1u) - 1u : bits + 1u);
  PRECISE double middle = 0.5 * (double(stored) + double(beside));
  return decode_depth(DEPTH_PERSPECTIVE, middle, near_depth, far_depth);
}
