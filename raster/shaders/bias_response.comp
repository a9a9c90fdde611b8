// Histograms of the biases at which the taps of the listed pixels flip, by cause and slope factor: BiasHistogram of
// core/shadow_taps.h.
#include "cause.glsl"
#include "pixel_list.glsl"
#include "response.glsl"
layout(local_size_x = LIST_GROUP_SIZE) in;
layout(std430, binding = BUFFER_HISTOGRAM) restrict buffer Histogram { uint words[]; };

// Sums are wider than a word: they carry.
void add_wide(uint word, uint value) {
  uint before = atomicAdd(words[word], value);
  if (before + value < before) atomicAdd(words[word + 1u], 1u);
}

void add_product(uint word, uint a, uint b) {
  uint high;
  uint low;
  umulExtended(a, b, high, low);
  uint before = atomicAdd(words[word], low);
  uint carry = before + low < before ? 1u : 0u;
  // The upper half of a product is never all ones, so that the carry fits.
  uint value = high + carry;
  if (value == 0u) return;
  before = atomicAdd(words[word + 1u], value);
  if (before + value < before) atomicAdd(words[word + 2u], 1u);
}

// How many biases of the axis leave the tap blocked.
uint bin_of(float flip) {
  int first = 0;
  int count = bias_count;
  while (count > 0) {
    int half_count = count / 2;
    if (axis_values[first + half_count] >= flip) {
      count = half_count;
    } else {
      first += half_count + 1;
      count -= half_count + 1;
    }
  }
  return uint(first);
}

void main() {
  if (gl_GlobalInvocationID.x >= pixel_count) return;
  ivec2 pixel = listed_pixel(gl_GlobalInvocationID.x);
  uvec2 id = texelFetch(ids, pixel, 0).rg;
  Lookup surfel = look_up(pixel);
  Pattern pattern = make_pattern(surfel.receiver, pixel);
  bool is_lit_in_truth = is_truly_lit(pixel);
  float easiest_bias = is_lit_in_truth ? least_bias : largest_bias;
  float easiest_factor = is_lit_in_truth ? least_slope : largest_slope;
  Facet own = fetch_facet(id);
  float critical_biases[most_taps];
  uint weights[most_taps];
  int causes[most_taps];
  for (int i = 0; i < tap_count; ++i) {
    WeightedTap tap = filter_tap(surfel.receiver, pattern, i);
    critical_biases[i] = tap.tap.critical_bias;
    weights[i] = tap.weight;
    causes[i] = -1;
    bool says_lit = easiest_bias >= flip_of(tap.tap.critical_bias, surfel.slope, easiest_factor);
    if (tap.weight > 0u && says_lit != is_lit_in_truth) {
      causes[i] = cause_of(tap.tap, is_lit_in_truth, surfel.receiver, id, own);
    }
  }
  uint side = is_lit_in_truth ? 0u : 1u;
  for (int s = 0; s < slope_count; ++s) {
    uint bins[most_taps];
    for (int i = 0; i < tap_count; ++i) {
      bins[i] = bin_of(flip_of(critical_biases[i], surfel.slope, axis_values[bias_count + s]));
    }
    for (int i = 0; i < tap_count; ++i) {
      // Bin 0 is lit at every bias, the last one blocked at every one: right all along where the truth says so.
      if (causes[i] < 0 || bins[i] == (is_lit_in_truth ? 0u : uint(bias_count))) continue;
      uint bin = HISTOGRAM_WORDS * (uint(s) * uint(bias_count + 1) + bins[i]);
      add_wide(bin + 2u * uint(causes[i]), weights[i]);
      // Taps in the order in which they turn wrong as the bias moves; equal ones by number. As tap i joins, the squared
      // error grows by w(w + sum) + w·sum, the sum being that of the taps before it.
      uint sum = 0u;
      for (int j = 0; j < tap_count; ++j) {
        bool comes_before = bins[j] == bins[i] ? j < i : (bins[j] > bins[i]) == is_lit_in_truth;
        if (comes_before) sum += weights[j];
      }
      add_product(bin + HISTOGRAM_SQUARES + 3u * side, weights[i], weights[i] + sum);
      if (sum > 0u) add_product(bin + HISTOGRAM_SQUARES + 3u * side, weights[i], sum);
      atomicMax(words[bin + HISTOGRAM_LARGEST + side], sum + weights[i]);
    }
  }
}
