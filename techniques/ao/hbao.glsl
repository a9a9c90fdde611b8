// HBAO (L. Bavoil, M. Sainz and R. Dimitrov, Image-Space Horizon-Based Ambient Occlusion, SIGGRAPH 2008 talks). Needs
// screen.glsl. docs/ambient-occlusion/hbao.md has the formulas.

struct HbaoSettings {
  int directions;
  int steps;
  float radius;        // metres
  float tangent_bias;  // radians
  float intensity;
  int is_jittered;
};

float accessibility(AoSurfel surfel, HbaoSettings settings) {
  vec3 viewer = direction_to_viewer(surfel.position);
  float radius = settings.radius * pixels_per_metre(surfel.position);
  float jitter = settings.is_jittered != 0 ? surfel.noise.y : 1.0f;
  float occlusion = 0.0f;
  for (int k = 0; k < settings.directions; ++k) {
    float azimuth = 6.28318531f * (float(k) + surfel.noise.x) / float(settings.directions);
    AoSlice slice = make_slice(surfel, viewer, azimuth, 0);
    // Sines of elevations above the plane perpendicular to the viewer's direction: first the tangent plane's.
    float highest = sin(min(settings.tangent_bias - slice.normal_angle, 1.57079633f));
    for (int i = 0; i < settings.steps; ++i) {
      float offset = max((float(i) + jitter) / float(settings.steps) * radius, 1.0f);
      ivec2 pixel = pixel_at(surfel, offset * slice.step);
      if (!has_surface(pixel)) continue;
      vec3 delta = seen_position(pixel) - surfel.position;
      float range = length(delta);
      if (range >= settings.radius || range <= 0.0f) continue;
      float sine = dot(delta, viewer) / range;
      if (sine <= highest) continue;
      float share = range / settings.radius;
      occlusion += (sine - highest) * (1.0f - share * share);
      highest = sine;
    }
  }
  return max(1.0f - settings.intensity * occlusion / float(settings.directions), 0.0f);
}
