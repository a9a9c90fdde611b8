#include "raster/shadow/esm_pass.h"

#include <cassert>

#include "raster/shader_interface.h"
#include "raster/texture_image.h"

namespace umbrameter {

FilteredMap filter(const gl::Context& context, const ShadowMap& map, const Esm& esm) {
  const int side = map.layout.resolution;
  const int layers = static_cast<int>(map.layout.views.size());
  const auto blur = [&](const gl::Texture& source, bool is_first) {
    gl::Texture blurred = gl::make_texture("exponential shadow map", gl::Format::r32f, side, side, layers);
    gl::Pass(context, {{"esm_blur.comp"}, define("WARP", is_first ? 1 : 0)})
        .texture("source", source)
        .image("blurred", blurred, gl::Format::r32f, true)
        .value("exponent", static_cast<float>(esm.params.exponent))
        .value("taps", esm.params.blur)
        .value("axis", is_first ? 1 : 0, is_first ? 0 : 1)
        .dispatch(side, side, layers);
    return blurred;
  };
  return {blur(blur(map.depth, true), false)};
}

RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const Esm& esm) {
  assert(lookup.filtered != nullptr);
  const int width = lookup.gbuffer.width;
  const int height = lookup.gbuffer.height;
  const gl::Texture visibility = gl::make_texture("visibility", gl::Format::r32f, width, height);
  lookup_pass(context, lookup, lookup.bias.constant.unit, {{"esm_visibility.comp"}, {}})
      .texture("moments", lookup.filtered->moments)
      .image("visibility_image", visibility, gl::Format::r32f)
      .value("exponent", static_cast<float>(esm.params.exponent))
      .dispatch(width, height);
  return {read_image<float>(visibility, gl::Format::r32f), {Image<uvec4>(width, height, uvec4(0)), 1}};
}

}  // namespace umbrameter
