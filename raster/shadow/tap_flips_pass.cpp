#include "raster/shadow/tap_flips_pass.h"

#include <cassert>

#include "raster/shadow/response_axes.h"
#include "raster/texture_image.h"

namespace umbrameter {

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

}  // namespace umbrameter
