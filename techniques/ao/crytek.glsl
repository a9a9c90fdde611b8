// Full-sphere SSAO (M. Mittring, Finding Next Gen: CryEngine 2, SIGGRAPH 2007 courses): the share of points in a sphere
// that the depth buffer does not hide. It reads no normal. Needs screen.glsl. docs/ambient-occlusion/crytek.md.

struct CrytekSettings {
  int samples;
  float radius;  // metres
  float bias;    // metres
  int is_range_checked;
};

/// Points uniform in the unit ball: a spherical Fibonacci lattice (R. Marques et al., Spherical Fibonacci Point Sets,
/// 2013) with a distance from a sequence of its own.
vec3 ball_point(int i, int count) {
  float z = 1.0f - (2.0f * float(i) + 1.0f) / float(count);
  float azimuth = 6.28318531f * fract(0.618033989f * float(i));
  float across = sqrt(max(1.0f - z * z, 0.0f));
  float distance = pow(fract(0.754877666f * float(i) + 0.5f), 1.0f / 3.0f);
  return distance * vec3(across * cos(azimuth), across * sin(azimuth), z);
}

float accessibility(AoSurfel surfel, CrytekSettings settings) {
  // The points are mirrored at a random plane.
  float z = 1.0f - 2.0f * surfel.noise.y;
  float across = sqrt(max(1.0f - z * z, 0.0f));
  vec3 mirror = vec3(across * cos(6.28318531f * surfel.noise.x), across * sin(6.28318531f * surfel.noise.x), z);
  float occlusion = 0.0f;
  for (int i = 0; i < settings.samples; ++i) {
    vec3 unit = ball_point(i, settings.samples);
    vec3 point = surfel.position + settings.radius * (unit - 2.0f * dot(unit, mirror) * mirror);
    vec4 clip = clip_from_view * vec4(point, 1.0f);
    if (!(clip.w > 0.0f)) continue;
    // Points outside the image are compared with its border, as by hemisphere SSAO.
    float x = floor((clip.x / clip.w * 0.5f + 0.5f) * float(size.x));
    float y = floor((clip.y / clip.w * 0.5f + 0.5f) * float(size.y));
    ivec2 pixel = ivec2(int(min(max(x, 0.0f), float(size.x - 1))), int(min(max(y, 0.0f), float(size.y - 1))));
    if (!has_surface(pixel)) continue;
    float seen = -depth_at(pixel);
    if (!(seen >= point.z + settings.bias)) continue;
    float weight = 1.0f;
    if (settings.is_range_checked != 0) {
      float apart = max(max(surfel.position.z - seen, seen - surfel.position.z), 1e-20f);
      weight = min(settings.radius / apart, 1.0f);
      weight = weight * weight * (3.0f - 2.0f * weight);
    }
    occlusion += weight;
  }
  return 1.0f - occlusion / float(settings.samples);
}
