// The settings of the technique, as prefiltered.glsl reads them.
#include "prefiltered.glsl"
uniform vec2 exponents;
uniform float min_variance;
uniform float bleeding_reduction;
uniform float moment_bias;
uniform float ringing_reduction;
uniform float contrast;

PrefilterSettings settings() {
  return PrefilterSettings(TECHNIQUE, IS_QUANTIZED, IS_HAUSDORFF, TERMS, exponents, min_variance, bleeding_reduction,
                           moment_bias, ringing_reduction, contrast);
}
