// Ray-marched SSAO: rays through the depth buffer, pixel by pixel. Needs screen.glsl.
// docs/ambient-occlusion/ray-marched.md has the formulas.

struct MarchedSettings {
  int rays;
  int steps;        // at most, along a ray
  float radius;     // metres
  float bias;       // metres above the tangent plane that do not occlude
  float thickness;  // metres, of every surface, along the camera's axis
  int is_uniform;   // 1: rays are uniform in the hemisphere; 0: weighted by the cosine
};

/// Ray `i` in the hemisphere about +z: a Fibonacci lattice, rotated and shifted by the pixel's noise.
vec3 march_direction(int i, vec2 noise, MarchedSettings settings) {
  float share = fract((float(i) + noise.x) / float(settings.rays));
  float azimuth = 6.28318531f * fract(0.618033989f * float(i) + noise.y);
  float z = settings.is_uniform != 0 ? share : sqrt(share);
  float across = sqrt(max(1.0f - z * z, 0.0f));
  return vec3(across * cos(azimuth), across * sin(azimuth), z);
}

/// Clip coordinates in pixels: x, y and w, so that x/w and y/w are the place in the image.
vec3 place_of(vec3 position) {
  vec4 clip = clip_from_view * vec4(position, 1.0f);
  return vec3((0.5f * clip.x + 0.5f * clip.w) * float(size.x), (0.5f * clip.y + 0.5f * clip.w) * float(size.y), clip.w);
}

/// Whether the depth buffer blocks the ray from the surfel to the end.
bool is_blocked(AoSurfel surfel, vec3 end, MarchedSettings settings) {
  vec3 from = place_of(surfel.position);
  vec3 to = place_of(end);
  // The part of the ray in front of the camera.
  if (to.z < 0.01f * from.z) {
    float kept = 0.99f * from.z / (from.z - to.z);
    end = surfel.position + kept * (end - surfel.position);
    to = place_of(end);
  }
  vec2 start = vec2(from.x / from.z, from.y / from.z);
  vec2 path = vec2(to.x / to.z, to.y / to.z) - start;
  float pixels = max(max(path.x, -path.x), max(path.y, -path.y));
  int steps = int(min(ceil(pixels), float(settings.steps)));
  for (int i = 0; i < steps; ++i) {
    float along = (float(i) + (float(steps) < pixels ? 0.5f + 0.5f * surfel.noise.x : 1.0f)) / float(steps);
    vec2 place = start + along * path;
    ivec2 pixel = ivec2(floor(place));
    if (pixel == surfel.pixel || !has_surface(pixel)) continue;
    // Even on the screen, distances along the ray follow from 1/w.
    float t = along * from.z / (along * from.z + (1.0f - along) * to.z);
    float ray_z = surfel.position.z + t * (end.z - surfel.position.z);
    vec3 seen = seen_position(pixel);
    if (seen.z < ray_z || seen.z > ray_z + settings.thickness) continue;
    vec3 delta = seen - surfel.position;
    // A surface below the tangent plane blocks no ray; neither does the surfel's own plane, whatever its slope.
    if (dot(delta, surfel.normal) <= settings.bias) continue;
    return true;
  }
  return false;
}

float accessibility(AoSurfel surfel, MarchedSettings settings) {
  vec3 n = surfel.normal;
  vec3 other = n.x > 0.5f || n.x < -0.5f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f);
  vec3 tangent = normalize(cross(n, other));
  vec3 bitangent = cross(n, tangent);
  int open = 0;
  for (int i = 0; i < settings.rays; ++i) {
    vec3 d = march_direction(i, surfel.noise, settings);
    vec3 end = surfel.position + settings.radius * (d.x * tangent + d.y * bitangent + d.z * n);
    if (!is_blocked(surfel, end, settings)) ++open;
  }
  return float(open) / float(settings.rays);
}
