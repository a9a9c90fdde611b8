#include "raster/ao/upsample_pass.h"

#include "raster/gl/pass.h"

namespace umbrameter {

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
