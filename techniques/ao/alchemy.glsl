// Alchemy AO (M. McGuire, B. Osman, M. Bukowski and P. Hennessy, The Alchemy Screen-Space Ambient Obscurance Algorithm,
// HPG 2011) and Scalable Ambient Obscurance (M. McGuire, M. Mara and D. Luebke, HPG 2012). Needs screen.glsl,
// depth_pyramid.glsl and depth_at_level(). docs/ambient-occlusion/alchemy.md has the formulas.

struct AlchemySettings {
  int samples;
  int turns;        // of the spiral
  float radius;     // metres
  float bias;       // metres above the tangent plane
  float intensity;
  int is_scalable;  // 1: the estimator of 2012
  int mip_levels;   // beyond level 0 of the depth pyramid; 0: every sample reads the depth buffer
  int mip_offset;   // level of a sample: floor(log2(pixels to it)) less this
};

/// What a surface at `delta` from the surfel adds.
float obscurance(vec3 delta, vec3 normal, AlchemySettings settings) {
  float square = dot(delta, delta);
  float limit = settings.radius * settings.radius;
  if (square >= limit) return 0.0f;
  float height = dot(delta, normal) - settings.bias;
  float epsilon = 1e-4f * limit;
  if (settings.is_scalable == 0) return 2.0f * settings.radius * max(height, 0.0f) / (square + epsilon);
  float share = 1.0f - square / limit;
  return 5.0f * settings.radius * share * share * share * max(height, 0.0f) / (square + epsilon);
}

/// The level that a sample reads at that distance, in pixels. Shifts give the exact floor of the logarithm.
int mip_level(float pixels, AlchemySettings settings) {
  int whole = int(min(pixels, 1e6f));
  int level = 0;
  while (level < settings.mip_levels && (whole >> (settings.mip_offset + level + 1)) > 0) ++level;
  // The coarsest level has one texel.
  while (level > 0 && (max(size.x, size.y) >> level) == 0) --level;
  return level;
}

/// Infinite outside the image and on the background.
float sample_depth(ivec2 pixel, int level) {
  if (!is_in_image(pixel)) return 1e38f;
  ivec2 last = level_size(size, level) - ivec2(1);
  return depth_at_level(ivec2(min(pixel.x >> level, last.x), min(pixel.y >> level, last.y)), level);
}

float accessibility(AoSurfel surfel, AlchemySettings settings) {
  float radius = settings.radius * pixels_per_metre(surfel.position);
  float sum = 0.0f;
  for (int i = 0; i < settings.samples; ++i) {
    float share = (float(i) + 0.5f) / float(settings.samples);
    float azimuth = 6.28318531f * (share * float(settings.turns) + surfel.noise.x);
    float across = max(share * radius, 1.0f);
    ivec2 pixel = pixel_at(surfel, across * vec2(cos(azimuth), sin(azimuth)));
    float seen = sample_depth(pixel, mip_level(across, settings));
    if (!(seen < 1e30f)) continue;
    sum += obscurance(position_at(pixel, seen) - surfel.position, surfel.normal, settings);
  }
  return max(1.0f - settings.intensity * sum / float(settings.samples), 0.0f);
}
