#include "raster/ao/blur_pass.h"

#include "raster/gl/pass.h"

namespace umbrameter {

gl::Texture blur(const gl::Context& context, const GpuGBuffer& gbuffer, gl::Texture ao, const AoBlurParams& params) {
  const AoBlurTaps taps = taps_of(params);
  if (taps.count == 1) return ao;
  const auto along = [&](const gl::Texture& source, int step_x, int step_y, bool is_last) {
    gl::Texture blurred = gl::make_texture("ao blurred", gl::Format::r32f, gbuffer.width, gbuffer.height);
    gl::Pass(context, {{"box_blur.comp"}, {}})
        .texture("ids", gbuffer.ids)
        .texture("source", source)
        .image("blurred", blurred, gl::Format::r32f)
        .value("axis", step_x, step_y)
        .value("first", taps.first)
        .value("taps", taps.count)
        .value("is_last", is_last ? 1 : 0)
        .dispatch(gbuffer.width, gbuffer.height);
    return blurred;
  };
  // Textures have the bottom row first: down is −y.
  return along(along(ao, 1, 0, false), 0, -1, true);
}

}  // namespace umbrameter
