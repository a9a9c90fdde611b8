// GTAO (J. Jimenez, X. Wu, A. Pesce and A. Jarabo, Practical Real-Time Strategies for Accurate Indirect Occlusion,
// SIGGRAPH 2016). Falloff, distribution of steps and thin-occluder heuristic are those of Intel's XeGTAO. Needs
// screen.glsl. docs/ambient-occlusion/gtao.md has the formulas.

struct GtaoSettings {
  int slices;
  int steps;                // on each side of a slice
  float radius;             // metres
  float falloff_range;      // share of the radius, at its end, over which occluders fade out
  float distribution;       // exponent of the steps' distances
  float thin_compensation;  // stretches depth differences in the falloff
  float power;              // of the result
  int is_even_in_angle;
};

/// ∫ cos(θ − n) sin θ dθ from 0 to h; θ is the angle from the viewer's direction, n that of the projected normal.
float inner_integral(float n, float h) { return 0.25f * (cos(n) + 2.0f * h * sin(n) - cos(2.0f * h - n)); }

/// What the slice sees between the horizons, weighted by the cosine to the normal: ∫ cos(θ − n) |sin θ| dθ from `low`
/// (at most 0) to `high` (at least 0), both cut at the normal's hemisphere. The mean over all slices of an open
/// hemisphere, times the length of the projected normal, is 1.
float slice_visibility(float n, float low, float high) {
  const float quarter = 1.57079633f;
  return inner_integral(n, max(low, n - quarter)) + inner_integral(n, min(high, n + quarter));
}

/// ∫ cos(θ − n) sin θ (cos θ, sin θ) dθ from 0 to h.
vec2 inner_direction(float n, float h) {
  float c = cos(h);
  float s = sin(h);
  float across = s * s * s / 3.0f;
  return vec2(cos(n) * (1.0f - c * c * c) / 3.0f + sin(n) * across,
              cos(n) * across + sin(n) * (2.0f / 3.0f - c + c * c * c / 3.0f));
}

/// The directions that slice_visibility() sees, with the same weight, summed as vectors.
vec3 slice_direction(AoSlice slice, vec3 viewer, float low, float high) {
  const float quarter = 1.57079633f;
  vec2 sum = inner_direction(slice.normal_angle, max(low, slice.normal_angle - quarter)) +
             inner_direction(slice.normal_angle, min(high, slice.normal_angle + quarter));
  return sum.x * viewer + sum.y * slice.towards;
}

/// The cosine of the horizon's angle from the viewer's direction, on one side of a slice.
float horizon_cosine(AoSurfel surfel, vec3 viewer, AoSlice slice, int index, float side, GtaoSettings settings) {
  float lowest = cos(slice.normal_angle + side * 1.57079633f);
  float horizon = lowest;
  float radius = settings.radius * pixels_per_metre(surfel.position);
  float fade_from = settings.radius * (1.0f - settings.falloff_range);
  for (int i = 0; i < settings.steps; ++i) {
    float jitter = fract(surfel.noise.y + 0.618034f * float(index + i * settings.steps));
    float share = pow((float(i) + jitter) / float(settings.steps), settings.distribution);
    // 1.3: past the surfel's own pixel in every direction.
    ivec2 pixel = pixel_at(surfel, side * (share * radius + 1.3f) * slice.step);
    if (!has_surface(pixel)) continue;
    vec3 delta = seen_position(pixel) - surfel.position;
    float thick = delta.z * (1.0f + settings.thin_compensation);
    float range = sqrt(delta.x * delta.x + delta.y * delta.y + thick * thick);
    float weight = min(max((settings.radius - range) / max(settings.radius - fade_from, 1e-20f), 0.0f), 1.0f);
    float cosine = dot(delta, viewer) / max(length(delta), 1e-20f);
    horizon = max(horizon, lowest + weight * (cosine - lowest));
  }
  return min(max(horizon, -1.0f), 1.0f);
}

/// The mean open direction, weighted by the cosine to the normal; 0 if no direction is open.
vec3 bent_normal(AoSurfel surfel, GtaoSettings settings) {
  vec3 viewer = direction_to_viewer(surfel.position);
  vec3 sum = vec3(0.0f);
  for (int i = 0; i < settings.slices; ++i) {
    float azimuth = 3.14159265f * (float(i) + surfel.noise.x) / float(settings.slices);
    AoSlice slice = make_slice(surfel, viewer, azimuth, settings.is_even_in_angle);
    float high = acos(horizon_cosine(surfel, viewer, slice, i, 1.0f, settings));
    float low = -acos(horizon_cosine(surfel, viewer, slice, i, -1.0f, settings));
    sum += slice.normal_length * slice_direction(slice, viewer, low, high);
  }
  return dot(sum, sum) > 0.0f ? normalize(sum) : vec3(0.0f);
}

/// Above 1 in some slices of an open plane; the mean over the noise is not.
float accessibility(AoSurfel surfel, GtaoSettings settings) {
  vec3 viewer = direction_to_viewer(surfel.position);
  float sum = 0.0f;
  for (int i = 0; i < settings.slices; ++i) {
    float azimuth = 3.14159265f * (float(i) + surfel.noise.x) / float(settings.slices);
    AoSlice slice = make_slice(surfel, viewer, azimuth, settings.is_even_in_angle);
    float high = acos(horizon_cosine(surfel, viewer, slice, i, 1.0f, settings));
    float low = -acos(horizon_cosine(surfel, viewer, slice, i, -1.0f, settings));
    sum += slice.normal_length * slice_visibility(slice.normal_angle, low, high);
  }
  return pow(max(sum / float(settings.slices), 0.0f), settings.power);
}
