// The settings of the technique, as prefiltered.glsl reads them.
#include "prefiltered.glsl"
uniform vec2 exponents;
uniform float min_variance;
uniform float bleeding_reduction;
uniform float moment_bias;

PrefilterSettings settings() {
  return PrefilterSettings(TECHNIQUE, IS_QUANTIZED, exponents, min_variance, bleeding_reduction, moment_bias);
}
