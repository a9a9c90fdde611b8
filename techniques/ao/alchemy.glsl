// Alchemy AO (M. McGuire, B. Osman, M. Bukowski and P. Hennessy, The Alchemy Screen-Space Ambient Obscurance Algorithm,
// HPG 2011) and Scalable Ambient Obscurance (M. McGuire, M. Mara and D. Luebke, HPG 2012) without its mip chain. Needs
// screen.glsl. docs/ambient-occlusion/alchemy.md has the formulas.
#ifndef SHARED
#define SHARED
#endif

struct AlchemySettings {
  int samples;
  int turns;        // of the spiral
  float radius;     // metres
  float bias;       // metres above the tangent plane
  float intensity;
  int is_scalable;  // 1: the estimator of 2012
};

/// What a surface at `delta` from the surfel adds.
SHARED float obscurance(vec3 delta, vec3 normal, AlchemySettings settings) {
  float square = dot(delta, delta);
  float limit = settings.radius * settings.radius;
  if (square >= limit) return 0.0f;
  float height = dot(delta, normal) - settings.bias;
  float epsilon = 1e-4f * limit;
  if (settings.is_scalable == 0) return 2.0f * settings.radius * max(height, 0.0f) / (square + epsilon);
  float share = 1.0f - square / limit;
  return 5.0f * settings.radius * share * share * share * max(height, 0.0f) / (square + epsilon);
}

SHARED float accessibility(AoSurfel surfel, AlchemySettings settings) {
  float radius = settings.radius * pixels_per_metre(surfel.position);
  float sum = 0.0f;
  for (int i = 0; i < settings.samples; ++i) {
    float share = (float(i) + 0.5f) / float(settings.samples);
    float azimuth = 6.28318531f * (share * float(settings.turns) + surfel.noise.x);
    ivec2 pixel = pixel_at(surfel, max(share * radius, 1.0f) * vec2(cos(azimuth), sin(azimuth)));
    if (!has_surface(pixel)) continue;
    sum += obscurance(seen_position(pixel) - surfel.position, surfel.normal, settings);
  }
  return max(1.0f - settings.intensity * sum / float(settings.samples), 0.0f);
}
