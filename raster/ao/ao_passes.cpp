#include "raster/ao/ao_passes.h"

#include "raster/gbuffer/view_block.h"

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

gl::Texture draw_normals(const gl::Context& context, const GpuGBuffer& gbuffer, const gl::Texture& linear_depth,
                         const View& view, AoInputParams params) {
  gl::Texture normals = gl::make_texture("ao normals", gl::Format::rgba32f, gbuffer.width, gbuffer.height);
  gl::Pass pass(context, {{"ao_normals.comp"}, shader_defines(describe(params))});
  bind(pass, gbuffer)
      .texture("linear_depth", linear_depth)
      .block("View", make_view_block(view))
      .image("normals", normals, gl::Format::rgba32f)
      .dispatch(gbuffer.width, gbuffer.height);
  return normals;
}

gl::Texture upsample(const gl::Context& context, const AoInputs& inputs, const gl::Texture& ao,
                     const AoParams& params) {
  const GpuGBuffer& gbuffer = inputs.gbuffer;
  gl::Texture upsampled = gl::make_texture("ao upsampled", gl::Format::r32f, gbuffer.width, gbuffer.height);
  gl::Pass pass(context, {{"upsample.comp"}, resolution_defines(inputs.resolution)});
  bind(pass, inputs)
      .texture("source", ao)
      .image("upsampled", upsampled, gl::Format::r32f)
      .value("plane_distance", static_cast<float>(params.resolution.plane_distance * params.sampling.radius.number))
      .value("normal_exponent", static_cast<float>(params.resolution.normal_exponent))
      .dispatch(gbuffer.width, gbuffer.height);
  return upsampled;
}

}  // namespace umbrameter
