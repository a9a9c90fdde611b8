#include "raster/ao/ao_inputs.h"

namespace umbrameter {

ivec2 ao_image_size(const AoInputs& inputs) {
  return ao_image_size(inputs.resolution, {inputs.gbuffer.width, inputs.gbuffer.height});
}

gl::Texture make_ao_image(const char* label, const AoInputs& inputs) {
  const ivec2 size = ao_image_size(inputs);
  return gl::make_texture(label, gl::Format::r32f, size.x, size.y);
}

gl::Pass& bind(gl::Pass& pass, const AoInputs& inputs) {
  return bind(pass, inputs.gbuffer)
      .texture("geometric_normal", inputs.normals)
      .texture("linear_depth", inputs.linear_depth);
}

std::string resolution_defines(AoResolution resolution) {
  AoResolutionParams params{resolution};
  return shader_defines({require(describe(params), "ao.resolution")});
}

}  // namespace umbrameter
