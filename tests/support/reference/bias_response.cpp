#include "tests/support/reference/bias_response.h"

#include <algorithm>
#include <cassert>

#include "core/parallel.h"
#include "tests/support/reference/same_surface.h"

namespace umbrameter {
namespace {

constexpr std::size_t lit_truth = 0;
constexpr std::size_t blocked_truth = 1;

struct FlippingTap {
  std::size_t bin = 0;
  std::uint32_t weight = 0;
  std::size_t cause = 0;
};

// Taps in the order in which they turn wrong: each adds to the pixel's error, and its square grows by the difference.
void count_pixel(std::vector<FlippingTap>& taps, bool is_lit, std::vector<BiasHistogram::Bin>& bins) {
  std::stable_sort(taps.begin(), taps.end(),
                   [&](const FlippingTap& a, const FlippingTap& b) { return is_lit ? a.bin > b.bin : a.bin < b.bin; });
  const std::size_t side = is_lit ? lit_truth : blocked_truth;
  std::uint32_t error = 0;
  for (const FlippingTap& tap : taps) {
    BiasHistogram::Bin& bin = bins[tap.bin];
    const WideCount before = static_cast<WideCount>(error) * error;
    error += tap.weight;
    bin.weights[tap.cause] += tap.weight;
    bin.squares[side] += static_cast<WideCount>(error) * error - before;
    bin.largest[side] = std::max(bin.largest[side], error);
  }
}

void add(BiasHistogram::Bin& sum, const BiasHistogram::Bin& part) {
  for (std::size_t c = 0; c < cause_count; ++c) sum.weights[c] += part.weights[c];
  for (std::size_t side = 0; side < 2; ++side) {
    sum.squares[side] += part.squares[side];
    sum.largest[side] = std::max(sum.largest[side], part.largest[side]);
  }
}

class PixelCounter {
 public:
  PixelCounter(const Scene& scene, const MapLookup& lookup, const BiasAxes& axes)
      : scene_(scene), lookup_(lookup), axes_(axes) {
    lookup_.bias.constant.unit = axes.unit;
  }

  void count(std::size_t pixel, bool is_lit, std::vector<std::vector<BiasHistogram::Bin>>& by_slope) {
    const SurfelLookup surfel = look_up(lookup_, pixel);
    if (!surfel.faces_light) return;
    fetch_taps(lookup_, surfel, pixel, taps_);
    causes_.assign(taps_.size(), unknown);
    const std::size_t never = is_lit ? 0 : axes_.constant.size();
    for (std::size_t s = 0; s < axes_.slope.size(); ++s) {
      flipping_.clear();
      for (std::size_t i = 0; i < taps_.size(); ++i) {
        const std::size_t bin =
            bias_bin(axes_, flip_bias(taps_[i].critical_bias, surfel.slope, axes_.slope[s]), surfel.bias_unit);
        if (taps_[i].weight == 0 || bin == never) continue;
        if (causes_[i] == unknown) causes_[i] = cause_of(taps_[i], surfel.receiver, pixel, is_lit);
        flipping_.push_back({bin, taps_[i].weight, causes_[i]});
      }
      count_pixel(flipping_, is_lit, by_slope[s]);
    }
  }

 private:
  static constexpr std::size_t unknown = cause_count;

  std::size_t cause_of(const Tap& tap, const Receiver& receiver, std::size_t pixel, bool is_lit) const {
    const bool is_other = is_other_surface(scene_, lookup_, tap, receiver, pixel, is_lit);
    if (is_lit) return static_cast<std::size_t>(is_other ? Cause::false_occlusion : Cause::acne);
    return static_cast<std::size_t>(is_other ? Cause::peter_panning : Cause::light_leak);
  }

  const Scene& scene_;
  MapLookup lookup_;
  const BiasAxes& axes_;
  std::vector<Tap> taps_;
  std::vector<std::size_t> causes_;
  std::vector<FlippingTap> flipping_;
};

}  // namespace

BiasHistogram count_bias_response(const Scene& scene, const MapLookup& lookup, const Image<float>& truth,
                                  const Image<PixelExclusion>& exclusion, const BiasAxes& axes) {
  assert(!axes.constant.empty() && !axes.slope.empty());
  assert(truth.size() == exclusion.size() && truth.size() == lookup.gbuffer.instance.size());
  constexpr std::size_t part_count = 16;
  const std::vector<std::vector<BiasHistogram::Bin>> empty(axes.slope.size(),
                                                           std::vector<BiasHistogram::Bin>(axes.constant.size() + 1));
  std::vector parts(part_count, empty);
  parallel_for(part_count, [&](std::size_t part) {
    PixelCounter counter(scene, lookup, axes);
    for (std::size_t i = part * truth.size() / part_count; i < (part + 1) * truth.size() / part_count; ++i) {
      if (exclusion[i] == PixelExclusion::none) counter.count(i, truth[i] >= 0.5f, parts[part]);
    }
  });
  BiasHistogram histogram{axes, lookup.filter.weight_sum(), empty};
  for (const auto& part : parts) {
    for (std::size_t s = 0; s < empty.size(); ++s) {
      for (std::size_t k = 0; k < empty[s].size(); ++k) add(histogram.by_slope[s][k], part[s][k]);
    }
  }
  return histogram;
}

}  // namespace umbrameter
