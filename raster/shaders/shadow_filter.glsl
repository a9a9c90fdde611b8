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
const uint kernel[FILTER_KERNEL_SIZE] = uint[](FILTER_KERNEL);
const int kernel_size = FILTER_KERNEL_SIZE;
#if FILTER_LINEAR
const int side = kernel_size + 1;
#else
const int side = kernel_size;
#endif

struct Pattern {
  ivec2 first;  // offset of the first tap from the receiver's texel, in texels
  uvec2 part;   // bilinear: offset of the receiver from the lower left texel centre, in 1/FILTER_PARTS texel
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
const vec2 disk_turns[FILTER_ROTATIONS] = vec2[](FILTER_ROTATION_LIST);

struct Pattern {
  vec2 turn;
};

// The same function as hash() in core/random.h.
uint hash(uint value) {
  uint state = value * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

Pattern make_pattern(Receiver receiver, ivec2 pixel) {
  uint column = uint(pixel.x);
  uint row = uint(textureSize(ids, 0).y - 1 - pixel.y);  // row 0 is the top row
  return Pattern(disk_turns[hash(column + 0x9e3779b9u * hash(row)) % uint(FILTER_ROTATIONS)]);
}

WeightedTap filter_tap(Receiver receiver, Pattern pattern, int i) {
  vec2 p = disk_points[i];
  precise vec2 turned = vec2(pattern.turn.x * p.x - pattern.turn.y * p.y, pattern.turn.y * p.x + pattern.turn.x * p.y);
  precise dvec2 texels = receiver.texels + dvec2(turned) * double(filter_radius);
  return WeightedTap(fetch_tap(receiver, ivec2(floor(texels)) - receiver.texel), 1u);
}
#endif
