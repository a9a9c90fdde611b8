// Convolution shadow maps (Annen, Mertens, Bekaert, Seidel and Kautz, Convolution Shadow Maps, EGSR 2007): the Fourier
// series of the step, two terms to a layer.

struct Settings {
  int terms;
  int is_quantized;  // 1 if the map holds (1 + value)/2
  float ringing_reduction;
  float contrast;
};

/// Frequency of a term of the Fourier series of a step that repeats with period 2; terms count from 1.
SHARED float fourier_frequency(int term) { return 3.14159265f * float(2 * term - 1); }

/// Cosine and sine of two terms, 2·layer + 1 and the next.
SHARED vec4 fourier_values(float depth, int layer) {
  float first = fourier_frequency(2 * layer + 1) * depth;
  float second = fourier_frequency(2 * layer + 2) * depth;
  return vec4(cos(first), sin(first), cos(second), sin(second));
}

/// What a layer of two terms adds to the blurred step: ½ + Σ (2/c)·(mean of sin(c·z)·cos(c·d) − of cos(c·z)·sin(c·d)).
SHARED float fourier_sum(vec4 values, float depth, int layer, Settings settings) {
  vec4 means = settings.is_quantized != 0 ? 2.0f * values - vec4(1.0f) : values;
  vec4 at = fourier_values(depth, layer);
  float sum = 0.0f;
  for (int i = 0; i < 2; ++i) {
    int term = 2 * layer + 1 + i;
    if (term > settings.terms) break;
    float part = float(term) / float(settings.terms);
    float weight = 2.0f / fourier_frequency(term) * exp(-settings.ringing_reduction * part * part);
    sum += weight * (means[2 * i + 1] * at[2 * i] - means[2 * i] * at[2 * i + 1]);
  }
  return sum;
}

SHARED vec4 map_values(float depth, int layer, Settings settings) {
  vec4 values = fourier_values(depth, layer);
  return settings.is_quantized != 0 ? 0.5f * values + vec4(0.5f) : values;
}

/// The sum up to a layer; after the last layer the visibility. Where all texels have the receiver's depth, the series
/// is ½.
SHARED float visibility_from(dvec4 values, double depth, int layer, float before, Settings settings) {
  float sum = before + fourier_sum(vec4(values), float(depth), layer, settings);
  if (2 * layer + 2 < settings.terms) return sum;
  return min(max(settings.contrast * (0.5f + sum), 0.0f), 1.0f);
}
