// GTAO with a visibility bitmask (O. Therrien, Y. Levesque and G. Gilet, Screen Space Indirect Lighting with Visibility
// Bitmask, 2023). Needs screen.glsl. docs/ambient-occlusion/bitmask.md has the formulas.
#include "gtao.glsl"

struct BitmaskSettings {
  int slices;
  int steps;           // on each side of a slice
  float radius;        // metres
  float distribution;  // exponent of the steps' distances
  float thickness;     // metres, of every surface, away from the viewer
  int is_cosine;       // 1: sectors have equal shares of the cosine-weighted slice; 0: equal angles
  int is_rounded_up;   // 1: a surface covers whole sectors; 0: those whose centres it covers
  int is_even_in_angle;
};

/// The share of a slice below an angle from the viewer's direction, from 0 at one end of the normal's hemisphere to 1.
float sector_position(float n, float angle, int is_cosine) {
  const float quarter = 1.57079633f;
  float low = n - quarter;
  float high = n + quarter;
  float cut = min(max(angle, low), high);
  if (is_cosine == 0) return (cut - low) / 3.14159265f;
  float below = inner_integral(n, low);
  float passed = cut < 0.0f ? below - inner_integral(n, cut) : below + inner_integral(n, cut);
  return min(max(passed / slice_visibility(n, low, high), 0.0f), 1.0f);
}

/// The sectors that a surface covers, which lies between two shares of the slice.
uint covered_sectors(float from, float to, int is_rounded_up) {
  uint first = 0u;
  uint count = 0u;
  if (is_rounded_up != 0) {
    first = min(uint(from * 32.0f), 31u);
    count = uint(max(ceil((to - from) * 32.0f), 0.0f));
  } else {
    first = uint(floor(from * 32.0f + 0.5f));
    count = uint(floor(to * 32.0f + 0.5f)) - first;
  }
  count = min(count, 32u - first);
  return count == 0u ? 0u : (0xffffffffu >> (32u - count)) << first;
}

uint side_sectors(AoSurfel surfel, vec3 viewer, AoSlice slice, int index, float side,
                   BitmaskSettings settings) {
  uint covered = 0u;
  float radius = settings.radius * pixels_per_metre(surfel.position);
  for (int i = 0; i < settings.steps; ++i) {
    float jitter = fract(surfel.noise.y + 0.618034f * float(index + i * settings.steps));
    float share = pow((float(i) + jitter) / float(settings.steps), settings.distribution);
    // 1.3: past the surfel's own pixel in every direction.
    ivec2 pixel = pixel_at(surfel, side * (share * radius + 1.3f) * slice.step);
    if (!has_surface(pixel)) continue;
    vec3 front = seen_position(pixel) - surfel.position;
    if (dot(front, front) >= settings.radius * settings.radius) continue;
    vec3 back = front - settings.thickness * viewer;
    float cosine = dot(front, viewer) / max(length(front), 1e-20f);
    float behind = dot(back, viewer) / max(length(back), 1e-20f);
    float near_angle = side * acos(min(max(cosine, -1.0f), 1.0f));
    float far_angle = side * acos(min(max(behind, -1.0f), 1.0f));
    float a = sector_position(slice.normal_angle, near_angle, settings.is_cosine);
    float b = sector_position(slice.normal_angle, far_angle, settings.is_cosine);
    covered = covered | covered_sectors(min(a, b), max(a, b), settings.is_rounded_up);
  }
  return covered;
}

int count_sectors(uint sectors) {
  int count = 0;
  for (int i = 0; i < 32; ++i) count += int((sectors >> uint(i)) & 1u);
  return count;
}

/// With a cosine, above 1 in some slices of an open plane; the mean over the noise is not.
float accessibility(AoSurfel surfel, BitmaskSettings settings) {
  vec3 viewer = direction_to_viewer(surfel.position);
  const float quarter = 1.57079633f;
  float sum = 0.0f;
  for (int i = 0; i < settings.slices; ++i) {
    float azimuth = 3.14159265f * (float(i) + surfel.noise.x) / float(settings.slices);
    AoSlice slice = make_slice(surfel, viewer, azimuth, settings.is_even_in_angle);
    uint covered = side_sectors(surfel, viewer, slice, i, 1.0f, settings) |
                   side_sectors(surfel, viewer, slice, i, -1.0f, settings);
    float open = float(32 - count_sectors(covered)) / 32.0f;
    if (settings.is_cosine != 0) {
      float n = slice.normal_angle;
      open = open * slice.normal_length * slice_visibility(n, n - quarter, n + quarter);
    }
    sum += open;
  }
  return sum / float(settings.slices);
}

/// The angle of a share of the slice: the inverse of sector_position().
float sector_angle(float n, float position, int is_cosine) {
  float low = n - 1.57079633f;
  if (is_cosine == 0) return low + 3.14159265f * position;
  float high = n + 1.57079633f;
  for (int i = 0; i < 20; ++i) {
    float middle = 0.5f * (low + high);
    if (sector_position(n, middle, 1) < position) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return 0.5f * (low + high);
}

/// ∫ cos(θ − n) |sin θ| (cos θ, sin θ) dθ from 0 to an angle.
vec2 directions_up_to(float n, float angle) {
  vec2 sum = inner_direction(n, angle);
  return angle < 0.0f ? -sum : sum;
}

/// The mean direction of the open sectors, weighted by the cosine to the normal whatever the weight of the sectors; 0 if
/// none is open.
vec3 bent_normal(AoSurfel surfel, BitmaskSettings settings) {
  vec3 viewer = direction_to_viewer(surfel.position);
  vec3 sum = vec3(0.0f);
  for (int i = 0; i < settings.slices; ++i) {
    float azimuth = 3.14159265f * (float(i) + surfel.noise.x) / float(settings.slices);
    AoSlice slice = make_slice(surfel, viewer, azimuth, settings.is_even_in_angle);
    uint covered = side_sectors(surfel, viewer, slice, i, 1.0f, settings) |
                   side_sectors(surfel, viewer, slice, i, -1.0f, settings);
    float n = slice.normal_angle;
    vec2 open = vec2(0.0f);
    vec2 before = directions_up_to(n, n - 1.57079633f);
    for (int k = 0; k < 32; ++k) {
      vec2 after = directions_up_to(n, sector_angle(n, float(k + 1) / 32.0f, settings.is_cosine));
      if (((covered >> uint(k)) & 1u) == 0u) open += after - before;
      before = after;
    }
    sum += slice.normal_length * (open.x * viewer + open.y * slice.towards);
  }
  return dot(sum, sum) > 0.0f ? normalize(sum) : vec3(0.0f);
}
