// Variance shadow maps (Donnelly and Lauritzen, I3D 2006).
#include "moment_bound.glsl"

struct Settings {
  float min_variance;  // of the depth
  float bleeding_reduction;
};

SHARED vec4 map_values(float depth, UNUSED int layer, UNUSED Settings settings) { return vec4(depth, depth * depth, 0.0f, 0.0f); }

SHARED float visibility_from(dvec4 values, double depth, UNUSED int layer, UNUSED float before, Settings settings) {
  double bound = chebyshev_bound(dvec2(values.x, values.y), depth, double(settings.min_variance));
  return float(reduce_bleeding(bound, double(settings.bleeding_reduction)));
}
