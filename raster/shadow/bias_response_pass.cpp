#include "raster/shadow/bias_response_pass.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>

#include "raster/shader_interface.h"
#include "raster/shadow/response_axes.h"

namespace umbrameter {
namespace {

// Slope factors that one pass takes, so that its histogram stays within this many bytes.
constexpr std::size_t max_histogram_bytes = std::size_t{64} << 20;

WideCount wide(std::span<const std::uint32_t> words) {
  WideCount value = 0;
  for (std::size_t i = words.size(); i-- > 0;) value = (value << 32u) | words[i];
  return value;
}

BiasHistogram::Bin read_bin(std::span<const std::uint32_t> words) {
  BiasHistogram::Bin bin;
  for (std::size_t c = 0; c < cause_count; ++c) {
    bin.weights[c] = static_cast<std::uint64_t>(wide(words.subspan(2 * c, 2)));
  }
  for (std::size_t side = 0; side < 2; ++side) {
    bin.squares[side] = wide(words.subspan(constant("HISTOGRAM_SQUARES") + 3 * side, 3));
    bin.largest[side] = words[constant("HISTOGRAM_LARGEST") + side];
  }
  return bin;
}

void draw_part(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes, BiasHistogram& histogram) {
  const gl::Buffer pixels = list_response_pixels(context, lookup, axes, false);

  const std::size_t bins = axes.constant.size() + 1;
  std::vector<std::uint32_t> words(axes.slope.size() * bins * constant("HISTOGRAM_WORDS"));
  const gl::Buffer counts = gl::make_buffer("bias histogram", std::span<const std::uint32_t>(words));
  gl::Pass pass = lookup_pass(context, lookup, axes.unit, {{"bias_response.comp"}, {}});
  bind_axes(pass, axes).buffer("PixelList", pixels).buffer("Histogram", counts);
  const auto taps = static_cast<std::size_t>(kernel_of(lookup).tap_count());
  dispatch_whole_list(context, pass, pixels, taps * axes.slope.size());
  gl::read_buffer(counts, std::as_writable_bytes(std::span(words)));
  for (std::size_t s = 0; s < axes.slope.size(); ++s) {
    std::vector<BiasHistogram::Bin>& of_slope = histogram.by_slope.emplace_back();
    for (std::size_t k = 0; k < bins; ++k) {
      of_slope.push_back(read_bin(std::span<const std::uint32_t>(words).subspan(
          (s * bins + k) * constant("HISTOGRAM_WORDS"), constant("HISTOGRAM_WORDS"))));
    }
  }
}

}  // namespace

BiasHistogram draw_bias_response(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes) {
  assert(lookup.truth != nullptr && !axes.constant.empty() && !axes.slope.empty());
  assert(std::is_sorted(axes.constant.begin(), axes.constant.end()));
  BiasHistogram histogram{axes, kernel_of(lookup).weight_sum(), {}};
  const std::size_t bytes = (axes.constant.size() + 1) * constant("HISTOGRAM_WORDS") * sizeof(std::uint32_t);
  const std::size_t at_once = std::max<std::size_t>(max_histogram_bytes / bytes, 1);
  for (std::size_t first = 0; first < axes.slope.size(); first += at_once) {
    const auto begin = axes.slope.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count = std::min(at_once, axes.slope.size() - first);
    draw_part(context, lookup, {axes.constant, {begin, begin + static_cast<std::ptrdiff_t>(count)}, axes.unit},
              histogram);
  }
  return histogram;
}

}  // namespace umbrameter
