// Exponential variance shadow maps with one or two warps (Lauritzen and McCool, Layered Variance Shadow Maps, GI 2008).
#include "moment_bound.glsl"

struct Settings {
  int has_second_warp;
  float positive_exponent;
  float negative_exponent;
  float min_variance;  // of the depth
  float bleeding_reduction;
};

/// exp(c₊·t) and −exp(−c₋·t) with t = 2·depth − 1, which both ascend with the depth.
SHARED vec2 warped(float depth, Settings settings) {
  float t = 2.0f * depth - 1.0f;
  return vec2(exp(settings.positive_exponent * t), -exp(-settings.negative_exponent * t));
}

/// chebyshev_bound() of a warped depth. The slope of the warp at the mean turns the least variance of the depth into
/// one of the warped depth. (Some implementations take the slope at the receiver; far behind the mean that leaves a
/// constant light of about 4·exponent²·min_variance.)
SHARED double warped_bound(dvec2 moments, double warped_depth, double exponent, double min_variance) {
  double slope = 2.0 * exponent * moments.x;
  return chebyshev_bound(moments, warped_depth, min_variance * slope * slope);
}

SHARED vec4 map_values(float depth, UNUSED int layer, Settings settings) {
  vec2 w = warped(depth, settings);
  return vec4(w.x, w.x * w.x, w.y, w.y * w.y);
}

SHARED float visibility_from(dvec4 values, double depth, UNUSED int layer, UNUSED float before, Settings settings) {
  vec2 w = warped(float(depth), settings);
  double min_variance = double(settings.min_variance);
  double bound =
      warped_bound(dvec2(values.x, values.y), double(w.x), double(settings.positive_exponent), min_variance);
  if (settings.has_second_warp != 0) {
    bound = min(bound, warped_bound(dvec2(values.z, values.w), double(w.y), double(settings.negative_exponent),
                                    min_variance));
  }
  return float(reduce_bleeding(bound, double(settings.bleeding_reduction)));
}
