#include "raster/shader_interface.h"
#include "raster/shadow/technique_passes.h"
#include "raster/texture_image.h"

namespace umbrameter {
namespace {

Image<uvec4> draw_wrong(const gl::Context& context, const ShadowLookup& lookup, const gl::Buffer& pixels, int taps) {
  const gl::Texture wrong =
      gl::make_texture("wrong taps", gl::Format::rgba32ui, lookup.gbuffer.width, lookup.gbuffer.height);
  gl::clear_texels(wrong, gl::Format::rgba32ui);
  gl::Pass pass = lookup_pass(context, lookup, lookup.bias.constant.unit, {{"classify.comp"}, {}});
  pass.buffer("PixelList", pixels).image("wrong_image", wrong, gl::Format::rgba32ui);
  dispatch_whole_list(context, pass, pixels, static_cast<std::size_t>(taps));
  return read_image<uvec4>(wrong, gl::Format::rgba32ui);
}

template <class Technique>
TechniqueMap map_of(const DrawnMap& drawn, const Technique& technique) {
  if constexpr (requires { filter(drawn, technique); }) return {filter(drawn, technique)};
  return {};
}

TechniqueMap map_of(const DrawnMap& drawn, const ContactShadows& technique) {
  return std::visit([&](const auto& each) { return map_of(drawn, each); }, technique.of_map);
}

}  // namespace

RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const Pcf& pcf) {
  const GpuGBuffer& gbuffer = lookup.gbuffer;
  const bool has_truth = lookup.truth != nullptr;
  const gl::Texture visibility = gl::make_texture("visibility", gl::Format::r32f, gbuffer.width, gbuffer.height);
  gl::Pass pass = lookup_pass(context, lookup, lookup.bias.constant.unit,
                              {{"visibility.comp"}, define("HAS_TRUTH", has_truth ? 1 : 0)});
  gl::Buffer pixels;
  if (has_truth) pixels = make_pixel_list(context, gbuffer);
  pass.buffer("PixelList", pixels)
      .image("visibility_image", visibility, gl::Format::r32f)
      .dispatch(gbuffer.width, gbuffer.height);

  RasterVisibility result;
  result.visibility = read_image<float>(visibility, gl::Format::r32f);
  result.wrong = {Image<uvec4>(gbuffer.width, gbuffer.height, uvec4(0)), pcf.kernel.weight_sum()};
  if (has_truth) result.wrong.weights = draw_wrong(context, lookup, pixels, pcf.kernel.tap_count());
  return result;
}

TechniqueMap filter_map(const DrawnMap& drawn, const ShadowTechnique& technique) {
  return std::visit([&](const auto& each) { return map_of(drawn, each); }, technique);
}

RasterVisibility draw_visibility(const gl::Context& context, const ShadowLookup& lookup) {
  return std::visit([&](const auto& technique) { return draw(context, lookup, technique); }, lookup.technique);
}

}  // namespace umbrameter
