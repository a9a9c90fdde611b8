#include "raster/ao/ssao_pass.h"

#include <cassert>
#include <cmath>
#include <span>

#include "core/random.h"
#include "raster/gbuffer/view_block.h"
#include "raster/gl/api.h"
#include "raster/shader_interface.h"
#include "raster/texture_image.h"

namespace umbrameter {
namespace {

// As AoBlock in shaders/ssao.comp, layout std140.
struct AoBlock {
  int samples = 0;
  int noise_size = 0;
  float radius = 0.0f;
  float bias = 0.0f;
};

enum class Purpose : std::uint32_t { kernel, rotation };

float random(std::uint32_t seed, Purpose purpose, int index, std::uint32_t dimension) {
  return to_unit_float(hash(seed, static_cast<std::uint32_t>(purpose), static_cast<std::uint32_t>(index), dimension));
}

std::string ao_defines(AoParams params) {
  const Parameters all = describe(params);
  return shader_defines({*find(all, "ao.range-check")});
}

void dispatch(const gl::Program& program, int width, int height) {
  glUseProgram(program.name());
  glDispatchCompute(group_count(width), group_count(height), 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

void blur_axis(const gl::Context& context, const gl::Texture& source, const gl::Texture& target, int width, int height,
               int step_x, int step_y, int taps, bool is_last) {
  const gl::Program& program = context.program({{"box_blur.comp"}, interface_defines()});
  glBindTextureUnit(slot("TEXTURE_AO"), source.name());
  glBindImageTexture(slot("IMAGE_AO"), target.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
  glProgramUniform4i(program.name(), location("UNIFORM_BLUR"), step_x, step_y, taps, is_last ? 1 : 0);
  dispatch(program, width, height);
}

}  // namespace

std::vector<vec4> ao_kernel(int samples, std::uint32_t seed) {
  std::vector<vec4> kernel;
  for (int i = 0; i < samples; ++i) {
    // Uniform on the hemisphere: z is uniform (Archimedes).
    const float z = random(seed, Purpose::kernel, i, 0);
    const float azimuth = static_cast<float>(2.0 * pi) * random(seed, Purpose::kernel, i, 1);
    const float across = std::sqrt(1.0f - z * z);
    const float share = static_cast<float>(i) / static_cast<float>(samples);
    const float length = random(seed, Purpose::kernel, i, 2) * (0.1f + 0.9f * share * share);
    kernel.emplace_back(length * across * std::cos(azimuth), length * across * std::sin(azimuth), length * z, 0.0f);
  }
  return kernel;
}

std::vector<vec4> ao_rotations(int noise_size, std::uint32_t seed) {
  std::vector<vec4> rotations;
  for (int i = 0; i < noise_size * noise_size; ++i) {
    rotations.emplace_back(2.0f * random(seed, Purpose::rotation, i, 0) - 1.0f,
                           2.0f * random(seed, Purpose::rotation, i, 1) - 1.0f, 0.0f, 0.0f);
  }
  return rotations;
}

Image<float> draw_ao(const gl::Context& context, const GpuGBuffer& gbuffer, const View& view, const AoParams& params,
                     std::uint32_t seed) {
  assert(params.radius.unit == LengthUnit::metres && params.bias.unit == LengthUnit::metres);
  const gl::Program& program = context.program({{"ssao.comp"}, interface_defines() + ao_defines(params)});
  std::vector<vec4> kernel_points = ao_kernel(params.samples, seed);
  kernel_points.resize(slot("MAX_SAMPLES"));
  const std::vector<vec4> rotation_vectors = ao_rotations(params.noise_size, seed);
  const gl::Buffer kernel = gl::make_buffer("ao kernel", std::span<const vec4>(kernel_points));
  const gl::Buffer rotations = gl::make_buffer("ao rotations", std::span<const vec4>(rotation_vectors));
  const gl::Buffer view_block = gl::make_block("view", make_view_block(view));
  const gl::Buffer ao_block =
      gl::make_block("ao", AoBlock{params.samples, params.noise_size, static_cast<float>(params.radius.number),
                                   static_cast<float>(params.bias.number)});
  const gl::Texture depth = gl::make_texture("ao linear depth", gl::Format::r32f, gbuffer.width, gbuffer.height);
  const gl::Texture raw = gl::make_texture("ao", gl::Format::r32f, gbuffer.width, gbuffer.height);
  glBindBufferBase(GL_UNIFORM_BUFFER, slot("BLOCK_KERNEL"), kernel.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot("BUFFER_ROTATIONS"), rotations.name());
  glBindBufferBase(GL_UNIFORM_BUFFER, slot("BLOCK_VIEW"), view_block.name());
  glBindBufferBase(GL_UNIFORM_BUFFER, slot("BLOCK_AO"), ao_block.name());
  glBindTextureUnit(slot("TEXTURE_IDS"), gbuffer.ids.name());
  glBindTextureUnit(slot("TEXTURE_POSITION_DEPTH"), gbuffer.position_depth.name());
  glBindTextureUnit(slot("TEXTURE_GEOMETRIC_NORMAL"), gbuffer.geometric_normal.name());
  glBindImageTexture(slot("IMAGE_DEPTH"), depth.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
  dispatch(context.program({{"linear_depth.comp"}, interface_defines()}), gbuffer.width, gbuffer.height);
  glBindTextureUnit(slot("TEXTURE_DEPTH"), depth.name());
  glBindImageTexture(slot("IMAGE_AO"), raw.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
  dispatch(program, gbuffer.width, gbuffer.height);

  if (params.blur == AoBlur::box && params.blur_size > 1) {
    // A box is the product of its axes.
    const gl::Texture across = gl::make_texture("ao blurred across", gl::Format::r32f, gbuffer.width, gbuffer.height);
    blur_axis(context, raw, across, gbuffer.width, gbuffer.height, 1, 0, params.blur_size, false);
    blur_axis(context, across, raw, gbuffer.width, gbuffer.height, 0, -1, params.blur_size, true);
  }
  Image<float> ao = read_image<float>(raw, gl::Format::r32f);
  context.check("ambient occlusion");
  return ao;
}

}  // namespace umbrameter
