// Moment shadow maps (Peters and Klein, Moment Shadow Mapping, I3D 2015).
#include "moment_bound.glsl"

struct Settings {
  int is_quantized;  // 1 if the map holds quantized_moments()
  int is_hausdorff;  // 1 for hausdorff_bound()
  float moment_bias;
  float bleeding_reduction;
};

/// Four moments in a basis that suits 16 bits, each from 0 to 1.
SHARED vec4 quantized_moments(vec4 moments) {
  return mat4(vec4(-2.07224649f, 13.7948857237f, 0.105877704f, 9.7924062118f),
              vec4(32.23703778f, -59.4683975703f, -1.9077466311f, -33.7652110555f),
              vec4(-68.571074599f, 82.0359750338f, 9.3496555107f, 47.9456096605f),
              vec4(39.3703274134f, -35.364903257f, -6.6543490743f, -23.9728048165f)) *
             moments +
         vec4(0.035955884801f, 0.0f, 0.0f, 0.0f);
}

/// The inverse of quantized_moments().
SHARED vec4 moments_of_quantized(vec4 code) {
  return mat4(vec4(0.2227744146f, 0.1549679261f, 0.1451988946f, 0.163127443f),
              vec4(0.0771972861f, 0.1394629426f, 0.2120202157f, 0.2591432266f),
              vec4(0.7926986636f, 0.7963415838f, 0.7258694464f, 0.6539092497f),
              vec4(0.0319417555f, -0.1722823173f, -0.2758014811f, -0.3376131734f)) *
         (code - vec4(0.035955884801f, 0.0f, 0.0f, 0.0f));
}

/// Of all distributions with the means b of the first four powers, one with three depths, `depth` among them, has the
/// most in front of `depth`. Returns the other two in ascending order. They are the roots of c.x + c.y·z + c.z·z², where
/// B·c = (1, d, d²) and B is the Hankel matrix ((1, b1, b2), (b1, b2, b3), (b2, b3, b4)).
SHARED dvec2 other_depths(dvec4 b, double depth) {
  // B = L·D·Lᵀ; the rounding of the stored moments can bring D to 0.
  double d22 = max(b.y - b.x * b.x, 1.0e-9);
  double l32_d22 = b.z - b.x * b.y;
  double l32 = l32_d22 / d22;
  double d33 = max(((b.w - b.y * b.y) * d22 - l32_d22 * l32_d22) / d22, 1.0e-12);
  double y2 = depth - b.x;
  double y3 = depth * depth - b.y - l32 * y2;
  if (y3 == 0.0) y3 = 1.0e-9;  // a root at infinity, with no weight
  dvec3 c;
  c.z = y3 / d33;
  c.y = y2 / d22 - l32 * c.z;
  c.x = 1.0 - b.x * c.y - b.y * c.z;
  // Without a difference of nearly equal numbers, even if one root is near infinity.
  double root = sqrt(max(c.y * c.y - 4.0 * c.x * c.z, 0.0));
  double q = -0.5 * (c.y + (c.y < 0.0 ? -root : root));
  double one = q / c.z;
  double other = q == 0.0 ? one : c.x / q;
  return dvec2(min(one, other), max(one, other));
}

/// The share at or behind `depth` of the distribution of other_depths().
SHARED double three_depth_share(dvec4 b, double depth, dvec2 others) {
  double near = others.x;
  double far = others.y;
  if (depth <= near) return 1.0;
  double bound;
  if (depth <= far) {  // all but the weight of the near root
    bound = 1.0 - (b.y - b.x * (depth + far) + depth * far) / ((near - depth) * (near - far));
  } else {  // the weight of the depth itself
    bound = (b.y - b.x * (near + far) + near * far) / ((depth - near) * (depth - far));
  }
  return min(max(bound, 0.0), 1.0);
}

/// Moments of the map, mixed with a share of a half at 0 and a half at 1.
SHARED dvec4 biased_moments(dvec4 moments, double bias) { return moments + bias * (dvec4(0.5) - moments); }

/// Upper bound of the share of texels at or behind a depth, from the means of the first four powers of their depths:
/// the sharpest that they allow, but for the bias (the Hamburger problem).
SHARED double hamburger_bound(dvec4 moments, double depth, double bias) {
  dvec4 b = biased_moments(moments, bias);
  return three_depth_share(b, depth, other_depths(b, depth));
}

/// The sharpest bound if the texels' depths are known to lie from 0 to 1 (the Hausdorff problem).
/// If one of the three depths of the Hamburger problem lies outside, the distribution has four depths: 0, 1, the
/// receiver's and a fourth x, which follows from the mean of z·(1 − z)·(z − d)·(z − x) = 0.
SHARED double hausdorff_bound(dvec4 moments, double depth, double bias) {
  if (depth <= 0.0) return 1.0;
  dvec4 b = biased_moments(moments, bias);
  dvec2 others = other_depths(b, depth);
  bool is_inside = others.x >= 0.0 && others.y <= 1.0;
  if (is_inside || depth >= 1.0) return three_depth_share(b, depth, others);
  double over = b.y - b.z - depth * (b.x - b.y);
  double x = over == 0.0 ? 1.0 : (b.z - b.w - depth * (b.y - b.z)) / over;  // 0: all texels are at 0 or 1
  x = min(max(x, 0.0), 1.0);
  double bound;
  if (x > depth) {  // all but the weight of 0
    bound = 1.0 + (b.z - (1.0 + depth + x) * b.y + (depth + x + depth * x) * b.x - depth * x) / (depth * x);
  } else {  // the weights of the receiver's depth and of 1
    bound = (b.z - (1.0 + x) * b.y + x * b.x) / (depth * max(depth - x, 1.0e-9) * (depth - 1.0)) +
            (b.z - (depth + x) * b.y + depth * x * b.x) / ((1.0 - depth) * (1.0 - x));
  }
  return min(max(bound, 0.0), 1.0);
}

SHARED vec4 map_values(float depth, UNUSED int layer, Settings settings) {
  float square = depth * depth;
  vec4 moments = vec4(depth, square, square * depth, square * square);
  return settings.is_quantized != 0 ? quantized_moments(moments) : moments;
}

SHARED float visibility_from(dvec4 values, double depth, UNUSED int layer, UNUSED float before, Settings settings) {
  dvec4 moments = values;
  if (settings.is_quantized != 0) moments = dvec4(moments_of_quantized(vec4(values)));
  double bound = settings.is_hausdorff != 0 ? hausdorff_bound(moments, depth, double(settings.moment_bias))
                                            : hamburger_bound(moments, depth, double(settings.moment_bias));
  return float(reduce_bleeding(bound, double(settings.bleeding_reduction)));
}
