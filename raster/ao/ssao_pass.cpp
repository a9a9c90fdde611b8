#include "raster/ao/ssao_pass.h"

#include <algorithm>
#include <array>
#include <span>

#include "raster/gbuffer/view_block.h"
#include "raster/gl/pass.h"
#include "raster/shader_interface.h"
#include "techniques/ao/kernel.h"

namespace umbrameter {

gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Ssao& ssao) {
  const GpuGBuffer& gbuffer = inputs.gbuffer;
  std::array<vec4, constant("MAX_SAMPLES")> kernel{};
  std::ranges::copy(hemisphere_kernel(ssao.sampling.samples, inputs.seed), kernel.begin());
  const std::vector<vec4> rotations = rotation_tile(ssao.noise, inputs.seed);
  gl::Texture ao = gl::make_texture("ao", gl::Format::r32f, gbuffer.width, gbuffer.height);
  SsaoParams params = ssao.params;
  gl::Pass pass(context, {{"ssao.comp"}, shader_defines(describe(params))});
  bind(pass, gbuffer)
      .texture("linear_depth", inputs.linear_depth)
      .block("View", make_view_block(inputs.view))
      .block("Kernel", kernel)
      .buffer("Rotations", gl::make_buffer("ao rotations", std::span<const vec4>(rotations)))
      .value("samples", ssao.sampling.samples)
      .value("noise_size", ssao.noise.size)
      .value("radius", static_cast<float>(ssao.sampling.radius.number))
      .value("bias", static_cast<float>(ssao.bias.depth.number))
      .image("ao_image", ao, gl::Format::r32f)
      .dispatch(gbuffer.width, gbuffer.height);
  return ao;
}

}  // namespace umbrameter
