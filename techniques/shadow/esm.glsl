// Exponential shadow maps (Annen et al., Exponential Shadow Maps, GI 2008).

struct Settings {
  float exponent;  // over the map's depth range
};

SHARED vec4 map_values(float depth, UNUSED int layer, Settings settings) {
  return vec4(exp(settings.exponent * depth), 0.0f, 0.0f, 0.0f);
}

SHARED float visibility_from(dvec4 values, double depth, UNUSED int layer, UNUSED float before, Settings settings) {
  return min(max(exp(-settings.exponent * float(depth)) * float(values.x), 0.0f), 1.0f);
}
