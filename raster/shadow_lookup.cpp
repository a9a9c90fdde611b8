#include "raster/shadow_lookup.h"

#include <cstdint>
#include <span>
#include <vector>

#include "raster/gl/api.h"
#include "raster/light_block.h"
#include "raster/shader_interface.h"
#include "raster/shadow_filter.h"
#include "raster/texture_image.h"

namespace umbrameter {

gl::Texture upload(const gl::Context& context, const Image<float>& image) {
  gl::Texture texture = upload_image("scalar image", gl::Format::r32f, image);
  context.check("image upload");
  return texture;
}

gl::Texture upload_truth(const gl::Context& context, const Image<float>& visibility, const Image<Counting>& counting) {
  Image<float> truth = visibility;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (counting[i] != Counting::counted) truth[i] = -1.0f;
  }
  return upload(context, truth);
}

std::string lookup_defines(const ShadowLookup& lookup) {
  return interface_defines() + map_defines(lookup.map.frame) + filter_defines(make_filter(lookup.params));
}

gl::Buffer bind(const ShadowLookup& lookup) {
  gl::Buffer block = gl::make_block("light", make_light_block(lookup.light, lookup.map.frame, lookup.params));
  glBindBufferBase(GL_UNIFORM_BUFFER, slot("BLOCK_LIGHT"), block.name());
  bind_triangles(lookup.scene);
  glBindTextureUnit(slot("TEXTURE_IDS"), lookup.gbuffer.ids.name());
  glBindTextureUnit(slot("TEXTURE_POSITION_DEPTH"), lookup.gbuffer.position_depth.name());
  glBindTextureUnit(slot("TEXTURE_GEOMETRIC_NORMAL"), lookup.gbuffer.geometric_normal.name());
  glBindTextureUnit(slot("TEXTURE_SHADOW_DEPTH"), lookup.map.depth.name());
  glBindTextureUnit(slot("TEXTURE_SHADOW_IDS"), lookup.map.ids.name());
  if (lookup.truth != nullptr) glBindTextureUnit(slot("TEXTURE_TRUTH"), lookup.truth->name());
  return block;
}

gl::Buffer bind_pixel_list(const GpuGBuffer& gbuffer) {
  const std::size_t pixels = static_cast<std::size_t>(gbuffer.width) * static_cast<std::size_t>(gbuffer.height);
  gl::Buffer list = gl::make_empty_buffer("pixel list", (4 + pixels) * sizeof(std::uint32_t));
  const std::uint32_t empty[] = {0, 1, 1, 0};  // no group yet, no pixel yet
  gl::write_buffer(list, 0, std::as_bytes(std::span(empty)));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot("BUFFER_PIXELS"), list.name());
  return list;
}

void dispatch_pixels(const gl::Program& program, const GpuGBuffer& gbuffer) {
  glUseProgram(program.name());
  glDispatchCompute(group_count(gbuffer.width), group_count(gbuffer.height), 1);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void dispatch_list(const gl::Program& program, const gl::Buffer& pixel_list) {
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, pixel_list.name());
  glUseProgram(program.name());
  glDispatchComputeIndirect(0);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace umbrameter
