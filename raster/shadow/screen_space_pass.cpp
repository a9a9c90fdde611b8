#include <algorithm>
#include <cassert>

#include "raster/gbuffer/view_block.h"
#include "raster/shadow/technique_passes.h"
#include "raster/texture_image.h"

namespace umbrameter {

RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const ScreenSpace& technique) {
  assert(lookup.view != nullptr);
  const int width = lookup.gbuffer.width;
  const int height = lookup.gbuffer.height;
  const gl::Texture visibility = gl::make_texture("visibility", gl::Format::r32f, width, height);
  lookup_pass(context, lookup, lookup.bias.constant.unit, {{"screen_space.comp"}, {}})
      .block("View", make_view_block(*lookup.view))
      .value("reach", technique.march.reach)
      .value("steps", technique.march.steps)
      .value("thickness", technique.march.thickness)
      .value("screen_bias", technique.march.bias)
      .value("is_jittered", technique.march.is_jittered)
      .value("uses_plane", technique.march.uses_plane)
      .image("visibility_image", visibility, gl::Format::r32f)
      .dispatch(width, height);
  return {read_image<float>(visibility, gl::Format::r32f), {Image<uvec4>(width, height, uvec4(0)), 1}};
}

RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const ContactShadows& technique) {
  ShadowLookup of_map = lookup;
  of_map.truth = nullptr;
  std::visit([&](const auto& each) { of_map.technique = each; }, technique.of_map);
  RasterVisibility both = draw_visibility(context, of_map);
  const Image<float> marched = draw(context, lookup, technique.march).visibility;
  std::ranges::transform(both.visibility.pixels, marched.pixels, both.visibility.pixels.begin(),
                         [](float a, float b) { return std::min(a, b); });
  both.wrong = {Image<uvec4>(marched.width, marched.height, uvec4(0)), 1};
  return both;
}

}  // namespace umbrameter
