// What filtered shadow maps store and how a look-up reads them. The shaders compile this text as GLSL, and
// prefiltered.h compiles it as C++ with GLM. A depth is the map's depth over its range, 0 to 1. Bounds from moments are
// computed in double precision: a variance is a small difference of stored numbers, and a look-up must not add rounding
// to that of the map's format.
// docs/techniques/filtered-maps.md has the formulas.
#ifndef SHARED
#define SHARED
#endif

const int ESM = 0;
const int VSM = 1;
const int EVSM2 = 2;
const int EVSM4 = 3;
const int MSM = 4;
const int CSM = 5;

struct PrefilterSettings {
  int technique;             // one of the above
  int is_quantized;          // MSM: 1 if the map holds quantized_moments(); CSM: 1 if it holds (1 + value)/2
  int is_hausdorff;          // MSM: 1 for hausdorff_bound()
  int terms;                 // CSM
  vec2 exponents;            // ESM: x; EVSM: positive, negative
  float min_variance;        // VSM and EVSM: of the depth
  float bleeding_reduction;  // VSM, EVSM and MSM
  float moment_bias;         // MSM
  float ringing_reduction;   // CSM
  float contrast;            // CSM
};

/// Upper bound of the share of texels at or behind a depth, from the mean of their depths and of their squares: the
/// one-tailed inequality of Chebyshev (Donnelly and Lauritzen, Variance Shadow Maps, I3D 2006).
SHARED double chebyshev_bound(dvec2 moments, double depth, double min_variance) {
  double behind = depth - moments.x;
  if (behind <= 0.0) return 1.0;
  double variance = max(moments.y - moments.x * moments.x, min_variance);
  return variance / (variance + behind * behind);
}

/// Cuts off the darkest part of the penumbra, where light bleeds, and stretches the rest (Lauritzen, Summed-Area
/// Variance Shadow Maps, GPU Gems 3, 2007).
SHARED double reduce_bleeding(double visibility, double amount) {
  return min(max((visibility - amount) / (1.0 - amount), 0.0), 1.0);
}

/// exp(c₊·t) and −exp(−c₋·t) with t = 2·depth − 1, which both ascend with the depth (Lauritzen and McCool, Layered
/// Variance Shadow Maps, GI 2008).
SHARED vec2 warped(float depth, vec2 exponents) {
  float t = 2.0f * depth - 1.0f;
  return vec2(exp(exponents.x * t), -exp(-exponents.y * t));
}

/// chebyshev_bound() of a warped depth. The slope of the warp at the mean turns the least variance of the depth into
/// one of the warped depth. (Some implementations take the slope at the receiver; far behind the mean that leaves a
/// constant light of about 4·exponent²·min_variance.)
SHARED double warped_bound(dvec2 moments, double warped_depth, double exponent, double min_variance) {
  double slope = 2.0 * exponent * moments.x;
  return chebyshev_bound(moments, warped_depth, min_variance * slope * slope);
}

/// Four moments in a basis that suits 16 bits, each from 0 to 1 (Peters and Klein, Moment Shadow Mapping, I3D 2015).
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
/// the sharpest that they allow, but for the bias (Peters and Klein 2015, the Hamburger problem).
SHARED double hamburger_bound(dvec4 moments, double depth, double bias) {
  dvec4 b = biased_moments(moments, bias);
  return three_depth_share(b, depth, other_depths(b, depth));
}

/// The sharpest bound if the texels' depths are known to lie from 0 to 1 (Peters and Klein 2015, the Hausdorff problem).
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

/// Frequency of a term of the Fourier series of a step that repeats with period 2; terms count from 1.
SHARED float fourier_frequency(int term) { return 3.14159265f * float(2 * term - 1); }

/// Cosine and sine of two terms, 2·group + 1 and the next (Annen, Mertens, Bekaert, Seidel and Kautz, Convolution
/// Shadow Maps, EGSR 2007).
SHARED vec4 fourier_values(float depth, int group) {
  float first = fourier_frequency(2 * group + 1) * depth;
  float second = fourier_frequency(2 * group + 2) * depth;
  return vec4(cos(first), sin(first), cos(second), sin(second));
}

/// What a group of two terms adds to the blurred step: ½ + Σ (2/c)·(mean of sin(c·z)·cos(c·d) − of cos(c·z)·sin(c·d)).
SHARED float fourier_sum(vec4 values, float depth, int group, PrefilterSettings settings) {
  vec4 means = settings.is_quantized != 0 ? 2.0f * values - vec4(1.0f) : values;
  vec4 at = fourier_values(depth, group);
  float sum = 0.0f;
  for (int i = 0; i < 2; ++i) {
    int term = 2 * group + 1 + i;
    if (term > settings.terms) break;
    float part = float(term) / float(settings.terms);
    float weight = 2.0f / fourier_frequency(term) * exp(-settings.ringing_reduction * part * part);
    sum += weight * (means[2 * i + 1] * at[2 * i] - means[2 * i] * at[2 * i + 1]);
  }
  return sum;
}

/// Visibility from the sum over all groups. Where all texels have the receiver's depth, the series is ½.
SHARED float fourier_visibility(float sum, PrefilterSettings settings) {
  return min(max(settings.contrast * (0.5f + sum), 0.0f), 1.0f);
}

/// What the map holds for a texel, before the blur. CSM has one layer for each group of two terms, the others one.
SHARED vec4 map_values(float depth, int group, PrefilterSettings settings) {
  if (settings.technique == CSM) {
    vec4 values = fourier_values(depth, group);
    return settings.is_quantized != 0 ? 0.5f * values + vec4(0.5f) : values;
  }
  if (settings.technique == ESM) return vec4(exp(settings.exponents.x * depth), 0.0f, 0.0f, 0.0f);
  float square = depth * depth;
  if (settings.technique == VSM) return vec4(depth, square, 0.0f, 0.0f);
  if (settings.technique == MSM) {
    vec4 moments = vec4(depth, square, square * depth, square * square);
    return settings.is_quantized != 0 ? quantized_moments(moments) : moments;
  }
  vec2 w = warped(depth, settings.exponents);
  return vec4(w.x, w.x * w.x, w.y, w.y * w.y);
}

/// Visibility of a receiver at a depth, 0 to 1, from the blurred values; not for CSM.
SHARED float visibility_from(dvec4 values, double depth, PrefilterSettings settings) {
  // Annen et al., Exponential Shadow Maps, GI 2008.
  if (settings.technique == ESM) {
    return min(max(exp(-settings.exponents.x * float(depth)) * float(values.x), 0.0f), 1.0f);
  }
  double bound = 1.0;
  if (settings.technique == VSM) {
    bound = chebyshev_bound(dvec2(values.x, values.y), depth, double(settings.min_variance));
  } else if (settings.technique == MSM) {
    dvec4 moments = values;
    if (settings.is_quantized != 0) moments = dvec4(moments_of_quantized(vec4(values)));
    bound = settings.is_hausdorff != 0 ? hausdorff_bound(moments, depth, double(settings.moment_bias))
                                       : hamburger_bound(moments, depth, double(settings.moment_bias));
  } else {
    vec2 w = warped(float(depth), settings.exponents);
    double min_variance = double(settings.min_variance);
    bound = warped_bound(dvec2(values.x, values.y), double(w.x), double(settings.exponents.x), min_variance);
    if (settings.technique == EVSM4) {
      bound = min(bound, warped_bound(dvec2(values.z, values.w), double(w.y), double(settings.exponents.y),
                                      min_variance));
    }
  }
  return float(reduce_bleeding(bound, double(settings.bleeding_reduction)));
}
