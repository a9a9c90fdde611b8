#include "raster/ao/ssao_pass.h"

#include <span>

#include "raster/gbuffer/view_block.h"
#include "raster/gl/api.h"
#include "raster/gl/compute_pass.h"
#include "raster/shader_interface.h"
#include "techniques/ao/kernel.h"

namespace umbrameter {
namespace {

// As AoBlock in shaders/ssao.comp, layout std140.
struct AoBlock {
  int samples = 0;
  int noise_size = 0;
  float radius = 0.0f;
  float bias = 0.0f;
};

}  // namespace

gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Ssao& ssao) {
  const GpuGBuffer& gbuffer = inputs.gbuffer;
  std::vector<vec4> points = hemisphere_kernel(ssao.sampling.samples, inputs.seed);
  points.resize(slot("MAX_SAMPLES"));
  const std::vector<vec4> tile = rotation_tile(ssao.noise, inputs.seed);
  const gl::Buffer kernel = gl::make_buffer("ao kernel", std::span<const vec4>(points));
  const gl::Buffer rotations = gl::make_buffer("ao rotations", std::span<const vec4>(tile));
  const gl::Buffer view = gl::make_block("view", make_view_block(inputs.view));
  const gl::Buffer block = gl::make_block(
      "ao", AoBlock{ssao.sampling.samples, ssao.noise.size, static_cast<float>(ssao.sampling.radius.number),
                    static_cast<float>(ssao.bias.depth.number)});
  glBindBufferBase(GL_UNIFORM_BUFFER, slot("BLOCK_KERNEL"), kernel.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot("BUFFER_ROTATIONS"), rotations.name());
  glBindBufferBase(GL_UNIFORM_BUFFER, slot("BLOCK_VIEW"), view.name());
  glBindBufferBase(GL_UNIFORM_BUFFER, slot("BLOCK_AO"), block.name());
  gl::Texture ao = gl::make_texture("ao", gl::Format::r32f, gbuffer.width, gbuffer.height);
  SsaoParams params = ssao.params;
  gl::ComputePass(context, "ssao.comp", shader_defines(describe(params)))
      .texture("ids", gbuffer.ids)
      .texture("position_depth", gbuffer.position_depth)
      .texture("linear_depth", inputs.linear_depth)
      .texture("geometric_normal", gbuffer.geometric_normal)
      .image("ao_image", ao, gl::Format::r32f)
      .dispatch(gbuffer.width, gbuffer.height);
  return ao;
}

}  // namespace umbrameter
