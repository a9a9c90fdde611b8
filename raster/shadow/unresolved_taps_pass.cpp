#include "raster/shadow/unresolved_taps_pass.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <vector>

#include "raster/shader_interface.h"
#include "raster/shadow/response_axes.h"

namespace umbrameter {
namespace {

// Taps of one run over a part of the pixels, so that there is room for every one of them: 32 MiB.
constexpr std::size_t max_taps_at_once = std::size_t{1} << 20;

static_assert(sizeof(UnresolvedTap) % sizeof(std::uint32_t) == 0);

}  // namespace

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
