// The taps of a filter. Every filter has the same interface: the number of taps, and the texel, critical bias and
// integer weight of each tap. The weights add up to weight_sum (FilterKernel in techniques/shadow/filter.h).
#include "surfel_lookup.glsl"

const int max_taps = FILTER_TAPS;  // equal to tap_count, but a compile-time constant
const uint weight_sum = FILTER_WEIGHT_SUM;

struct WeightedTap {
  Tap tap;
  uint weight;
};

#if FILTER_IS_GRID
const uint kernel_sums[FILTER_KERNEL_SIZE + 1] = uint[](FILTER_KERNEL_SUMS);  // of the first 0, 1, … n weights
const int kernel_size = FILTER_KERNEL_SIZE;
#if FILTER_LINEAR
const int side = kernel_size + 1;
#else
const int side = kernel_size;
#endif

struct Pattern {
  ivec2 first;  // offset of the first tap from the receiver's texel, in texels
  uvec2 part;   // bilinear: offset of the receiver from the lower left tap of the middle, in 1/FILTER_PARTS texel
};

// An odd kernel has its middle on a texel centre, an even one on a texel corner.
Pattern make_pattern(Lookup surfel, ivec2 pixel) {
  Receiver receiver = surfel.receiver;
  Pattern pattern;
  pattern.first = ivec2(-(kernel_size / 2));
  pattern.part = uvec2(0u);
#if FILTER_LINEAR
  double half_texel = kernel_size % 2 == 0 ? 0.0lf : 0.5lf;
  dvec2 base = floor(receiver.texels - half_texel);
  pattern.first += ivec2(base) - receiver.texel;
  pattern.part = uvec2(floor((receiver.texels - half_texel - base) * double(FILTER_PARTS) + 0.5lf));
#else
  if (kernel_size % 2 == 0) pattern.first += ivec2(floor(receiver.texels + 0.5lf)) - receiver.texel;
#endif
  return pattern;
}

#if FILTER_AREA_SUM
// area_tent_part() of tests/support/reference/taps.h.
uint area_tent_part(int x) {
  uint width = uint(kernel_size * FILTER_PARTS);
  uint at = uint(clamp(x, 0, int(width)));
  uint twice_area = width * width / 2u;
  uint right = width - at;
  uint part = 2u * at <= width ? at * at : twice_area - right * right;
  return (part * uint(FILTER_AREA_SUM) + twice_area / 2u) / twice_area;
}
#endif

// axis_weights() of tests/support/reference/taps.cpp.
uint weight_left_of(int i, uint part) {
#if FILTER_AREA_SUM
  return area_tent_part(i * FILTER_PARTS - int(part));
#elif FILTER_LINEAR
  uint sum = kernel_sums[min(i, kernel_size)] * (uint(FILTER_PARTS) - part) + kernel_sums[max(i - 1, 0)] * part;
  return (sum + FILTER_DIVISOR / 2u) / FILTER_DIVISOR;
#else
  return kernel_sums[i];
#endif
}

uint axis_weight(int i, uint part) { return weight_left_of(i + 1, part) - weight_left_of(i, part); }

WeightedTap filter_tap(Receiver receiver, Pattern pattern, int i) {
  ivec2 at = ivec2(i % side, i / side);
  return WeightedTap(fetch_tap(receiver, pattern.first + at),
                     axis_weight(at.x, pattern.part.x) * axis_weight(at.y, pattern.part.y));
}
#else
const vec2 disk_points[FILTER_TAPS] = vec2[](FILTER_POINT_LIST);
const vec2 disk_turns[FILTER_ROTATIONS] = vec2[](FILTER_ROTATION_LIST);

struct Pattern {
  vec2 turn;
  float radius;  // texels
};

// The same function as hash() in core/random.h.
uint hash(uint value) {
  uint state = value * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

// The rotation of a pixel's disk. Row 0 is the top row.
vec2 turn_of(ivec2 pixel) {
  uint column = uint(pixel.x);
  uint row = uint(textureSize(ids, 0).y - 1 - pixel.y);
#if FILTER_ROTATION == 0
  return disk_turns[hash(column + 0x9e3779b9u * hash(row)) % uint(FILTER_ROTATIONS)];
#elif FILTER_ROTATION == 1
  return disk_turns[0];
#else
  // Interleaved gradient noise (J. Jimenez, Next Generation Post Processing in Call of Duty: Advanced Warfare, 2014).
  precise double sum = 0.06711056lf * double(column) + 0.00583715lf * double(row);
  precise double scaled = 52.9829189lf * (sum - floor(sum));
  precise double noise = (scaled - floor(scaled)) * double(FILTER_ROTATIONS);
  return disk_turns[min(uint(noise), uint(FILTER_ROTATIONS) - 1u)];
#endif
}

// Offset of a point of the unit disk from the receiver's texel.
ivec2 disk_offset(Receiver receiver, vec2 p, vec2 turn, float radius) {
  precise vec2 turned = vec2(turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y);
  precise dvec2 texels = receiver.texels + dvec2(turned) * double(radius);
  return ivec2(floor(texels)) - receiver.texel;
}

#if FILTER_SEARCH || FILTER_HARDENS
// Radius of the cone from the receiver to the light at a depth, as the map shows it at the receiver: metres.
double penumbra_at(double depth, double blocker) {
  precise double apart = depth - blocker;
#if MAP_KIND == MAP_ORTHOGRAPHIC
  precise double radius = double(search_extent) * apart;
#else
  precise double radius = double(search_extent) * apart / blocker;
#endif
  return radius;
}
#endif

#if FILTER_SEARCH
const vec2 search_points[FILTER_SEARCH] = vec2[](FILTER_SEARCH_LIST);

// BlockerSearch of techniques/shadow/filter.h: the radius of the penumbra, in texels.
float search_radius(Lookup surfel, vec2 turn) {
  Receiver receiver = surfel.receiver;
  double texel = double(texel_at(receiver));
  double reach = double(max_radius);
#if MAP_KIND == MAP_ORTHOGRAPHIC
  reach = min(reach, penumbra_at(receiver.depth, 0.0lf) / texel);
#endif
  precise double sum = 0.0lf;
  int count = 0;
  for (int i = 0; i < search_count; ++i) {
    vec2 p = search_points[i];
    Tap tap = fetch_tap(receiver, disk_offset(receiver, p, turn, float(reach)));
    if (!tap.has_blocker || is_lit(tap.critical_bias, surfel)) continue;
    double blocker = blocker_depth(receiver, tap.critical_bias);
    if (!(blocker > 0.0lf)) continue;
    precise double squared = double(p.x) * double(p.x) + double(p.y) * double(p.y);
    precise double away = sqrt(squared) * reach * texel;
    if (search_in_cone != 0 && away > penumbra_at(receiver.depth, blocker)) continue;
    sum += blocker;
    ++count;
  }
  if (count == 0) return min_radius;
  precise double mean = sum / double(count);
  precise double radius = penumbra_at(receiver.depth, mean) / texel;
  return clamp(float(radius), min_radius, max_radius);
}
#endif

#if FILTER_HARDENS
// Radius of the disk of DPCF, in texels: that of the light, as the map shows it from the receiver.
float light_radius(Receiver receiver) {
#if MAP_KIND == MAP_ORTHOGRAPHIC
  double radius = penumbra_at(receiver.depth, 0.0lf);
#else
  double radius = double(search_extent);
#endif
  return float(min(double(max_radius), radius / double(texel_at(receiver))));
}
#endif

Pattern make_pattern(Lookup surfel, ivec2 pixel) {
  vec2 turn = turn_of(pixel);
#if FILTER_HARDENS
  return Pattern(turn, light_radius(surfel.receiver));
#elif FILTER_SEARCH
  return Pattern(turn, search_radius(surfel, turn));
#else
  return Pattern(turn, filter_radius);
#endif
}

WeightedTap filter_tap(Receiver receiver, Pattern pattern, int i) {
  return WeightedTap(fetch_tap(receiver, disk_offset(receiver, disk_points[i], pattern.turn, pattern.radius)), 1u);
}

#if FILTER_HARDENS
#include "hardening.glsl"

// ContactHardening of techniques/shadow/filter.h.
float hardened_visibility(Lookup surfel, Pattern pattern) {
  Receiver receiver = surfel.receiver;
  precise double sum = 0.0lf;
  int count = 0;
  for (int i = 0; i < tap_count; ++i) {
    Tap tap = filter_tap(receiver, pattern, i).tap;
    if (is_lit(tap.critical_bias, surfel)) continue;
    sum += blocker_depth(receiver, tap.critical_bias);
    ++count;
  }
  if (count == 0) return 1.0;
  precise double mean = sum / double(count);
  precise double disk = double(pattern.radius) * double(texel_at(receiver));
  precise double softness =
      mean > 0.0lf && disk > 0.0lf ? clamp(penumbra_at(receiver.depth, mean) / disk, 0.0lf, 1.0lf) : 1.0lf;
  return 1.0 - float(hardened(double(count) / double(tap_count), softness));
}
#endif
#endif
