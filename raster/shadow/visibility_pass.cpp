#include "raster/shadow/visibility_pass.h"

#include "raster/gl/api.h"
#include "raster/shader_interface.h"
#include "raster/shadow/filter_defines.h"
#include "raster/shadow/technique_passes.h"
#include "raster/texture_image.h"

namespace umbrameter {
namespace {

Image<uvec4> draw_wrong(const gl::Context& context, const gl::Program& program, const GpuGBuffer& gbuffer,
                        const gl::Buffer& pixels, int taps) {
  const gl::Texture wrong = gl::make_texture("wrong taps", gl::Format::rgba32ui, gbuffer.width, gbuffer.height);
  const unsigned zero[] = {0, 0, 0, 0};
  glClearTexImage(wrong.name(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, zero);
  glBindImageTexture(slot("IMAGE_WRONG"), wrong.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32UI);
  dispatch_whole_list(context, program, pixels, static_cast<std::size_t>(taps));
  return read_image<uvec4>(wrong, gl::Format::rgba32ui);
}

}  // namespace

RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const Pcf& pcf) {
  const GpuGBuffer& gbuffer = lookup.gbuffer;
  const bool has_truth = lookup.truth != nullptr;
  const std::string defines = lookup_defines(lookup) + define("HAS_TRUTH", has_truth ? 1 : 0);
  const gl::Program& program = context.program({{"visibility.comp"}, defines});
  const gl::Buffer block = bind(lookup, lookup.bias.constant.unit);
  const gl::Texture visibility = gl::make_texture("visibility", gl::Format::r32f, gbuffer.width, gbuffer.height);
  glBindImageTexture(slot("IMAGE_VISIBILITY"), visibility.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
  gl::Buffer pixels;
  if (has_truth) pixels = bind_pixel_list(context, gbuffer);
  dispatch_pixels(program, gbuffer);

  RasterVisibility result;
  result.visibility = read_image<float>(visibility, gl::Format::r32f);
  const FilterKernel& filter = pcf.kernel;
  result.wrong = {Image<uvec4>(gbuffer.width, gbuffer.height, uvec4(0)), filter.weight_sum()};
  if (has_truth) {
    const gl::Program& classify = context.program({{"classify.comp"}, defines});
    result.wrong.weights = draw_wrong(context, classify, gbuffer, pixels, filter.tap_count());
  }
  context.check("visibility");
  return result;
}

RasterVisibility draw_visibility(const gl::Context& context, const ShadowLookup& lookup) {
  return std::visit([&](const auto& technique) { return draw(context, lookup, technique); }, lookup.technique);
}

}  // namespace umbrameter
