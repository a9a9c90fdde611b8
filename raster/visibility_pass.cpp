#include "raster/visibility_pass.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "raster/gl/api.h"
#include "raster/light_block.h"
#include "raster/shader_interface.h"
#include "raster/texture_image.h"

namespace umbrameter {
namespace {

// What changes the shader's text. Biases stay out: a sweep over them must not compile anew.
std::string filter_defines(ShadowParams params) {
  const Parameters all = describe(params);
  return shader_defines({*find(all, "shadow.filter"), *find(all, "shadow.filter-size")});
}

// As WrongPixels in shaders/wrong_pixels.glsl: no group yet, no pixel yet, room for all.
gl::Buffer make_wrong_pixels(const GpuGBuffer& gbuffer) {
  const std::size_t pixels = static_cast<std::size_t>(gbuffer.width) * static_cast<std::size_t>(gbuffer.height);
  std::vector<std::uint32_t> words(4 + pixels);
  words[1] = words[2] = 1;
  return gl::make_buffer("wrong pixels", std::span<const std::uint32_t>(words));
}

Image<vec4> draw_classes(const gl::Program& program, const GpuGBuffer& gbuffer, const gl::Buffer& wrong_pixels) {
  const gl::Texture classes =
      gl::make_texture("shadow error classes", gl::Format::rgba32f, gbuffer.width, gbuffer.height);
  const float zero[] = {0, 0, 0, 0};
  glClearTexImage(classes.name(), 0, GL_RGBA, GL_FLOAT, zero);
  glBindImageTexture(slot("IMAGE_CLASSES"), classes.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, wrong_pixels.name());
  glUseProgram(program.name());
  glDispatchComputeIndirect(0);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  return read_image<vec4>(classes, gl::Format::rgba32f);
}

}  // namespace

RasterVisibility draw_visibility(const gl::Context& context, const UploadedScene& scene, const GpuGBuffer& gbuffer,
                                 const ShadowMap& map, const Light& light, const ShadowParams& params,
                                 const gl::Texture* truth) {
  const bool has_truth = truth != nullptr;
  const std::string defines =
      interface_defines() + map_defines(map.frame) + filter_defines(params) + define("HAS_TRUTH", has_truth ? 1 : 0);
  const gl::Program& program = context.program({{"visibility.comp"}, defines});
  const gl::Buffer block = gl::make_block("light", make_light_block(light, map.frame, params));
  glBindBufferBase(GL_UNIFORM_BUFFER, slot("BLOCK_LIGHT"), block.name());
  bind_triangles(scene);
  glBindTextureUnit(slot("TEXTURE_IDS"), gbuffer.ids.name());
  glBindTextureUnit(slot("TEXTURE_POSITION_DEPTH"), gbuffer.position_depth.name());
  glBindTextureUnit(slot("TEXTURE_GEOMETRIC_NORMAL"), gbuffer.geometric_normal.name());
  glBindTextureUnit(slot("TEXTURE_SHADOW_DEPTH"), map.depth.name());
  glBindTextureUnit(slot("TEXTURE_SHADOW_IDS"), map.ids.name());

  const gl::Texture visibility = gl::make_texture("visibility", gl::Format::r32f, gbuffer.width, gbuffer.height);
  glBindImageTexture(slot("IMAGE_VISIBILITY"), visibility.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
  gl::Buffer wrong_pixels;
  if (has_truth) {
    wrong_pixels = make_wrong_pixels(gbuffer);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot("BUFFER_WRONG"), wrong_pixels.name());
    glBindTextureUnit(slot("TEXTURE_TRUTH"), truth->name());
  }
  glUseProgram(program.name());
  glDispatchCompute(group_count(gbuffer.width), group_count(gbuffer.height), 1);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);

  RasterVisibility result;
  result.visibility = read_image<float>(visibility, gl::Format::r32f);
  result.classes = Image<vec4>(gbuffer.width, gbuffer.height, vec4(0));
  if (has_truth) {
    result.classes = draw_classes(context.program({{"classify.comp"}, defines}), gbuffer, wrong_pixels);
  }
  context.check("visibility");
  return result;
}

gl::Texture upload(const gl::Context& context, const Image<float>& image) {
  gl::Texture texture = upload_image("scalar image", gl::Format::r32f, image);
  context.check("image upload");
  return texture;
}

}  // namespace umbrameter
