// Computes the histogram of the biases at which the taps of the listed pixels flip, by cause and slope factor:
// BiasHistogram of techniques/shadow/histogram.h.
#include "cause.glsl"
#include "pixel_list.glsl"
#include "response.glsl"
layout(local_size_x = LIST_GROUP_SIZE) in;
layout(std430) restrict buffer Histogram { uint words[]; };

// Adds to a 64-bit sum of two words, with carry.
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
  // high + carry does not overflow: the upper half of a product is never all ones.
  uint value = high + carry;
  if (value == 0u) return;
  before = atomicAdd(words[word + 1u], value);
  if (before + value < before) atomicAdd(words[word + 2u], 1u);
}

struct WrongTap {
  float critical_bias;
  uint weight;
  bool is_other_surface;
};
WrongTap wrong_taps[max_taps];  // wrong at some bias
int wrong_count = 0;

// Sorts the taps in the order in which they become wrong: as the bias decreases if the truth is lit, as it increases if
// the truth is blocked. One order serves all slope factors, because the bin of a flip never decreases as the critical
// bias grows. Shellsort (Knuth, The Art of Computer Programming 3, 5.2.1, algorithm D) with his increments 1, 4, 13, ….
void sort_taps(bool is_lit_in_truth) {
  int gap = 1;
  while (3 * gap + 1 < wrong_count) gap = 3 * gap + 1;
  for (; gap > 0; gap /= 3) {
    for (int i = gap; i < wrong_count; ++i) {
      WrongTap tap = wrong_taps[i];
      int place = i;
      while (place >= gap) {
        WrongTap other = wrong_taps[place - gap];
        bool stays = is_lit_in_truth ? other.critical_bias >= tap.critical_bias
                                     : other.critical_bias <= tap.critical_bias;
        if (stays) break;
        wrong_taps[place] = other;
        place -= gap;
      }
      wrong_taps[place] = tap;
    }
  }
}

void main() {
  uint index = first_pixel + gl_GlobalInvocationID.x;
  if (index >= end_pixel) return;
  ivec2 pixel = listed_pixel(index);
  uvec2 id = texelFetch(ids, pixel, 0).rg;
  Lookup surfel = look_up(pixel);
  Pattern pattern = make_pattern(surfel, pixel);
  bool is_lit_in_truth = is_lit_in_reference(pixel);
  float easiest_bias = is_lit_in_truth ? min_bias : max_bias;
  float easiest_factor = is_lit_in_truth ? min_slope : max_slope;
  Facet own = fetch_facet(id);
  for (int i = 0; i < tap_count; ++i) {
    WeightedTap tap = filter_tap(surfel.receiver, pattern, i);
    bool says_lit =
        is_lit_at(easiest_bias, surfel.bias_unit, flip_bias(tap.tap.critical_bias, surfel.slope, easiest_factor));
    if (tap.weight == 0u || says_lit == is_lit_in_truth) continue;
    int cause = cause_of(tap.tap, is_lit_in_truth, surfel.receiver, id, own);
    bool is_other_surface = cause == (is_lit_in_truth ? CAUSE_FALSE_OCCLUSION : CAUSE_PETER_PANNING);
    wrong_taps[wrong_count++] = WrongTap(tap.tap.critical_bias, tap.weight, is_other_surface);
  }
  sort_taps(is_lit_in_truth);
  uint side = is_lit_in_truth ? 0u : 1u;
  uint own_word = 2u * uint(is_lit_in_truth ? CAUSE_ACNE : CAUSE_LIGHT_LEAK);
  uint other_word = 2u * uint(is_lit_in_truth ? CAUSE_FALSE_OCCLUSION : CAUSE_PETER_PANNING);
  // Taps in this bin are never wrong. If the truth is lit, it is bin 0 (lit at every bias); otherwise the last bin
  // (blocked at every bias).
  uint never = is_lit_in_truth ? 0u : uint(bias_count);
  for (int s = 0; s < slope_count; ++s) {
    float factor = bias_axis_values[bias_count + s];
    uint sum = 0u;  // weight of the taps in the bins visited so far
    int i = 0;
    while (i < wrong_count) {
      uint bin = bias_bin(flip_bias(wrong_taps[i].critical_bias, surfel.slope, factor), surfel.bias_unit);
      if (bin == never) break;
      // The bias nearest to the flip at which the taps of this bin are wrong. If the truth is lit, it is the bias
      // bin - 1, where they are blocked; if the truth is blocked, it is the bias bin, where they are lit.
      float bound = bias_axis_values[is_lit_in_truth ? bin - 1u : bin];
      uint own_weight = 0u;
      uint other_weight = 0u;
      do {
        own_weight += wrong_taps[i].is_other_surface ? 0u : wrong_taps[i].weight;
        other_weight += wrong_taps[i].is_other_surface ? wrong_taps[i].weight : 0u;
        ++i;
      } while (i < wrong_count &&
               is_lit_at(bound, surfel.bias_unit, flip_bias(wrong_taps[i].critical_bias, surfel.slope, factor)) !=
                   is_lit_in_truth);
      uint first = HISTOGRAM_WORDS * (uint(s) * uint(bias_count + 1) + bin);
      if (own_weight > 0u) add_wide(first + own_word, own_weight);
      if (other_weight > 0u) add_wide(first + other_word, other_weight);
      // When taps of weight w are added to `sum`, the squared error grows by (sum + w)² − sum² = w(w + sum) + w·sum.
      uint weight = own_weight + other_weight;
      add_product(first + HISTOGRAM_SQUARES + 3u * side, weight, weight + sum);
      if (sum > 0u) add_product(first + HISTOGRAM_SQUARES + 3u * side, weight, sum);
      sum += weight;
      atomicMax(words[first + HISTOGRAM_LARGEST + side], sum);
    }
  }
}
