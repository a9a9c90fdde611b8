// The taps of the filter, the one interface of every filter: how many there are, and of each its texel, its critical
// bias and a whole-number weight. The weights add up to weight_sum (techniques/shadow/filter.h; FilterKernel).
#include "surfel_lookup.glsl"

const int max_taps = FILTER_TAPS;  // tap_count of them are there
const uint weight_sum = FILTER_WEIGHT_SUM;

struct WeightedTap {
  Tap tap;
  uint weight;
};

#if FILTER_IS_GRID
const uint kernel[FILTER_KERNEL_SIZE] = uint[](FILTER_KERNEL);
const int kernel_size = FILTER_KERNEL_SIZE;
#if FILTER_LINEAR
const int side = kernel_size + 1;
#else
const int side = kernel_size;
#endif

struct Pattern {
  ivec2 first;  // texels from the receiver's own to the first tap
  uvec2 part;   // of a texel, that the receiver lies right and up of its lower left centre
};

Pattern make_pattern(Receiver receiver, ivec2 pixel) {
  Pattern pattern;
  pattern.first = ivec2(-(kernel_size / 2));
  pattern.part = uvec2(0u);
#if FILTER_LINEAR
  dvec2 base = floor(receiver.texels - 0.5lf);
  pattern.first += ivec2(base) - receiver.texel;
  pattern.part = uvec2(floor((receiver.texels - 0.5lf - base) * double(FILTER_PARTS) + 0.5lf));
#endif
  return pattern;
}

uint axis_weight(int i, uint part) {
#if FILTER_LINEAR
  return (i < kernel_size ? kernel[i] * (uint(FILTER_PARTS) - part) : 0u) + (i > 0 ? kernel[i - 1] * part : 0u);
#else
  return kernel[i];
#endif
}

WeightedTap filter_tap(Receiver receiver, Pattern pattern, int i) {
  ivec2 at = ivec2(i % side, i / side);
  return WeightedTap(fetch_tap(receiver, pattern.first + at),
                     axis_weight(at.x, pattern.part.x) * axis_weight(at.y, pattern.part.y));
}
#else
const vec2 disk_points[FILTER_TAPS] = vec2[](FILTER_POINT_LIST);
const vec2 disk_turns[FILTER_TURNS] = vec2[](FILTER_TURN_LIST);

struct Pattern {
  vec2 turn;
};

// hash() of core/random.h.
uint hash(uint value) {
  uint state = value * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

Pattern make_pattern(Receiver receiver, ivec2 pixel) {
  uint column = uint(pixel.x);
  uint row = uint(textureSize(ids, 0).y - 1 - pixel.y);  // from the top, as images count
  return Pattern(disk_turns[hash(column + 0x9e3779b9u * hash(row)) % uint(FILTER_TURNS)]);
}

WeightedTap filter_tap(Receiver receiver, Pattern pattern, int i) {
  vec2 p = disk_points[i];
  precise vec2 turned = vec2(pattern.turn.x * p.x - pattern.turn.y * p.y, pattern.turn.y * p.x + pattern.turn.x * p.y);
  precise dvec2 texels = receiver.texels + dvec2(turned) * double(filter_radius);
  return WeightedTap(fetch_tap(receiver, ivec2(floor(texels)) - receiver.texel), 1u);
}
#endif
