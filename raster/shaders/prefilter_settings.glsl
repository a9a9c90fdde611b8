// The settings of the technique, as prefiltered.glsl reads them.
#include "prefiltered.glsl"
uniform vec2 exponents;

// The look-up's own settings are the last five.
PrefilterSettings settings_of_map() {
  return PrefilterSettings(TECHNIQUE, IS_QUANTIZED, IS_HAUSDORFF, TERMS, exponents, 0.0, 0.0, 0.0, 0.0, 0.0);
}
