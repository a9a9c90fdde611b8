#include "raster/shadow/shadow_lookup.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "raster/gl/api.h"
#include "raster/shader_interface.h"
#include "raster/shadow/filter_defines.h"
#include "raster/shadow/light_block.h"
#include "raster/texture_image.h"

namespace umbrameter {
namespace {

// A desktop ends a dispatch that holds the device for some seconds. So many steps are a fraction of a second on a slow
// GPU, even where each classifies a tap: some 600 operations in double precision, of which it does 10^11 a second.
constexpr std::size_t max_steps_at_once = std::size_t{1} << 26;

// Fewer pixels would leave most of a GPU idle.
constexpr std::size_t min_at_once = 4096;

// OpenGL promises no more than 65535 work groups (GL_MAX_COMPUTE_WORK_GROUP_COUNT).
constexpr std::size_t max_at_once = std::size_t{65535} * slot("LIST_GROUP_SIZE");

}  // namespace

gl::Texture upload(const gl::Context& context, const Image<float>& image) {
  gl::Texture texture = upload_image("scalar image", gl::Format::r32f, image);
  context.check("image upload");
  return texture;
}

gl::Texture upload_truth(const gl::Context& context, const Image<float>& visibility,
                         const Image<PixelExclusion>& exclusion) {
  Image<float> truth = visibility;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (exclusion[i] != PixelExclusion::none) truth[i] = -1.0f;
  }
  return upload(context, truth);
}

const FilterKernel& kernel_of(const ShadowLookup& lookup) { return std::get<Pcf>(lookup.technique).kernel; }

std::string lookup_defines(const ShadowLookup& lookup) {
  return interface_defines() + map_defines(lookup.map.layout) + filter_defines(kernel_of(lookup));
}

gl::Buffer bind(const ShadowLookup& lookup, LengthUnit bias_unit) {
  LightBlock values = make_light_block(lookup.light, lookup.map.layout);
  values.constant_bias = static_cast<float>(lookup.bias.constant.number);
  values.slope_bias = static_cast<float>(lookup.bias.slope);
  values.normal_offset = static_cast<float>(lookup.bias.normal_offset);
  if (const auto* pcf = std::get_if<Pcf>(&lookup.technique)) {
    values.tap_count = pcf->kernel.tap_count();
    values.filter_radius = pcf->kernel.radius;
  }
  values.bias_in_texels = bias_unit == LengthUnit::texels ? 1 : 0;
  gl::Buffer block = gl::make_block("light", values);
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

gl::Buffer bind_pixel_list(const gl::Context& context, const GpuGBuffer& gbuffer) {
  const std::size_t pixels = static_cast<std::size_t>(gbuffer.width) * static_cast<std::size_t>(gbuffer.height);
  const std::size_t bytes = (1 + pixels) * sizeof(std::uint32_t);
  if (bytes > context.max_storage_bytes()) {
    throw Error(ExitCode::usage, "view.size",
                "'" + std::to_string(gbuffer.width) + "x" + std::to_string(gbuffer.height) +
                    "' has more pixels than a list on " + context.device().renderer + " can hold",
                "at most " + std::to_string(context.max_storage_bytes() / sizeof(std::uint32_t) - 1) + " pixels");
  }
  gl::Buffer list = gl::make_empty_buffer("pixel list", bytes);
  const std::uint32_t none[] = {0};
  gl::write_buffer(list, 0, std::as_bytes(std::span(none)));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot("BUFFER_PIXELS"), list.name());
  return list;
}

void dispatch_pixels(const gl::Program& program, const GpuGBuffer& gbuffer) {
  glUseProgram(program.name());
  glDispatchCompute(group_count(gbuffer.width), group_count(gbuffer.height), 1);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

std::uint32_t count_listed(const gl::Context& context, const gl::Buffer& pixel_list) {
  std::array<std::uint32_t, 1> count{};
  gl::read_buffer(pixel_list, std::as_writable_bytes(std::span(count)));
  context.check("pixel list");
  return count[0];
}

void dispatch_list(const gl::Program& program, const ListedPixels& pixels) {
  assert(pixels.end >= pixels.first && pixels.end - pixels.first <= max_at_once);
  glUseProgram(program.name());
  glUniform1ui(location("UNIFORM_FIRST_PIXEL"), pixels.first);
  glUniform1ui(location("UNIFORM_END_PIXEL"), pixels.end);
  glDispatchCompute((pixels.end - pixels.first + slot("LIST_GROUP_SIZE") - 1) / slot("LIST_GROUP_SIZE"), 1, 1);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void dispatch_whole_list(const gl::Context& context, const gl::Program& program, const gl::Buffer& pixel_list,
                         std::size_t steps) {
  const std::uint32_t pixels = count_listed(context, pixel_list);
  const auto at_once = static_cast<std::uint32_t>(
      std::clamp<std::size_t>(max_steps_at_once / std::max<std::size_t>(steps, 1), min_at_once, max_at_once));
  for (std::uint32_t first = 0; first < pixels; first += std::min(at_once, pixels - first)) {
    dispatch_list(program, {first, first + std::min(at_once, pixels - first)});
    if (at_once < pixels) glFlush();
  }
}

}  // namespace umbrameter
