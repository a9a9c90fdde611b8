#include "raster/shadow/response_passes.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <vector>

#include "raster/gl/pass.h"
#include "raster/shader_interface.h"
#include "raster/texture_image.h"

namespace umbrameter {
namespace {

/// As ResponseBlock in shaders/response.glsl, layout std140.
struct ResponseBlock {
  float min_bias = 0.0f;
  float largest_bias = 0.0f;
  float min_slope = 0.0f;
  float largest_slope = 0.0f;
  int bias_count = 0;
  int slope_count = 0;
  int unused[2] = {};
};
static_assert(sizeof(ResponseBlock) == 32);

ResponseBlock make_block(const BiasAxes& axes) {
  const auto [least, largest] = std::ranges::minmax_element(axes.slope);
  return {axes.constant.front(),
          axes.constant.back(),
          *least,
          *largest,
          static_cast<int>(axes.constant.size()),
          static_cast<int>(axes.slope.size())};
}

// Uploads and binds the axes, neither of which may be empty.
gl::Pass& bind_axes(gl::Pass& pass, const BiasAxes& axes) {
  std::vector<float> both = axes.constant;
  both.insert(both.end(), axes.slope.begin(), axes.slope.end());
  return pass.block("ResponseBlock", make_block(axes))
      .buffer("Axes", gl::make_buffer("biases", std::span<const float>(both)));
}

// Lists the pixels that have a wrong tap at some bias of the axes; lit_alone: only those that are lit in the truth.
gl::Buffer list_response_pixels(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes,
                                bool lit_alone) {
  gl::Buffer list = make_pixel_list(context, lookup.gbuffer);
  gl::Pass pass =
      lookup_pass(context, lookup, axes.unit, {{"response_pixels.comp"}, define("LIT_ALONE", lit_alone ? 1 : 0)});
  bind_axes(pass, axes).buffer("PixelList", list).dispatch(lookup.gbuffer.width, lookup.gbuffer.height);
  return list;
}

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

// Taps of one run over a part of the pixels, so that there is room for every one of them: 32 MiB.
constexpr std::size_t max_taps_at_once = std::size_t{1} << 20;

static_assert(sizeof(UnresolvedTap) % sizeof(std::uint32_t) == 0);

}  // namespace

BiasHistogram draw_bias_response(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes) {
  assert(lookup.truth != nullptr && !axes.constant.empty() && !axes.slope.empty());
  assert(std::ranges::is_sorted(axes.constant));
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

TapFlips draw_tap_flips(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes) {
  assert(lookup.truth != nullptr && kernel_of(lookup).tap_count() == 1);
  assert(!axes.constant.empty() && axes.slope.size() == 1);
  const int width = lookup.gbuffer.width;
  const int height = lookup.gbuffer.height;
  const gl::Buffer pixels = list_response_pixels(context, lookup, axes, false);
  const gl::Texture drawn = gl::make_texture("tap flips", gl::Format::rg32ui, width, height);
  gl::clear_texels(drawn, gl::Format::rg32ui);
  gl::Pass pass = lookup_pass(context, lookup, axes.unit, {{"tap_flips.comp"}, {}});
  bind_axes(pass, axes).buffer("PixelList", pixels).image("flip_image", drawn, gl::Format::rg32ui);
  dispatch_whole_list(context, pass, pixels, 1);
  const Image<uvec2> words = read_image<uvec2>(drawn, gl::Format::rg32ui);
  TapFlips flips{axes, Image<std::uint16_t>(width, height), Image<Cause>(width, height)};
  for (std::size_t i = 0; i < words.size(); ++i) {
    flips.bin[i] = static_cast<std::uint16_t>(words[i].x);
    flips.cause[i] = static_cast<Cause>(words[i].y);
  }
  return flips;
}

void list_unresolved_taps(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes, bool of_lit,
                          const UnresolvedTapSink& sink) {
  assert(lookup.truth != nullptr && !axes.constant.empty() && !axes.slope.empty());
  const gl::Buffer list = list_response_pixels(context, lookup, axes, of_lit);
  const std::uint32_t pixels = count_listed(context, list);
  if (pixels == 0) return;

  const auto taps = static_cast<std::size_t>(kernel_of(lookup).tap_count());
  const auto at_once = static_cast<std::uint32_t>(
      std::min<std::size_t>(pixels, std::max<std::size_t>(max_taps_at_once / taps, constant("LIST_GROUP_SIZE"))));
  const gl::Buffer found =
      gl::make_empty_buffer("unresolved taps", sizeof(std::uint32_t) + at_once * taps * sizeof(UnresolvedTap));
  gl::Pass pass = lookup_pass(context, lookup, axes.unit, {{"unresolved_taps.comp"}, define("OF_LIT", of_lit ? 1 : 0)});
  bind_axes(pass, axes).buffer("PixelList", list).buffer("UnresolvedTaps", found);
  std::vector<std::byte> words;
  std::vector<UnresolvedTap> records;
  for (std::uint32_t first = 0; first < pixels; first += at_once) {
    const std::uint32_t count = std::min(at_once, pixels - first);
    std::array<std::uint32_t, 1> header{};
    gl::write_buffer(found, 0, std::as_bytes(std::span(header)));
    dispatch_list(pass, {first, first + count});
    gl::read_buffer(found, std::as_writable_bytes(std::span(header)));
    if (header[0] == 0) continue;
    words.resize(sizeof(header) + header[0] * sizeof(UnresolvedTap));
    gl::read_buffer(found, words);
    records.resize(header[0]);
    std::copy(words.begin() + sizeof(header), words.end(), std::as_writable_bytes(std::span(records)).begin());
    sink(records);
  }
}

}  // namespace umbrameter
