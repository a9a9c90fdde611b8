#include "raster/ao/ao_passes.h"
#include "raster/gl/pass.h"

namespace umbrameter {

namespace {

gl::Texture blur_along(const gl::Context& context, const AoInputs& inputs, const gl::Texture& source,
                       const AoParams& ao, const ivec2& axis) {
  const AoBlurParams& params = ao.blur;
  const AoBlurTaps taps = taps_of(params);
  const bool is_box = params.kind == AoBlur::box;
  const bool is_bilateral = params.kind == AoBlur::bilateral;
  gl::Texture blurred = make_ao_image("ao blurred", inputs);
  gl::Pass pass(context, {{is_box ? "box_blur.comp" : "weighted_blur.comp"}, resolution_defines(inputs.resolution)});
  const ivec2 size = ao_image_size(inputs);
  bind(pass, inputs)
      .texture("source", source)
      .image("blurred", blurred, gl::Format::r32f)
      .value("axis", axis.x, axis.y)
      .value("first", taps.first)
      .value("taps", taps.count)
      .value("is_last", axis.y != 0 ? 1 : 0)
      .value("deviation", static_cast<float>(deviation_of(params)))
      .value("plane_distance",
             is_bilateral ? static_cast<float>(params.plane_distance * ao.sampling.radius.number) : 0.0f)
      .value("normal_exponent", is_bilateral ? static_cast<float>(params.normal_exponent) : 0.0f)
      .dispatch(size.x, size.y);
  return blurred;
}

gl::Texture denoise(const gl::Context& context, const AoInputs& inputs, const gl::Texture& source, bool is_last) {
  gl::Texture denoised = make_ao_image("ao denoised", inputs);
  const ivec2 size = ao_image_size(inputs);
  gl::Pass pass(context, {{"xegtao_denoise.comp"}, resolution_defines(inputs.resolution)});
  bind(pass, inputs)
      .texture("source", source)
      .image("blurred", denoised, gl::Format::r32f)
      .value("center_weight", static_cast<float>(is_last ? denoiser_center_weight : denoiser_center_weight / 5.0))
      .dispatch(size.x, size.y);
  return denoised;
}

}  // namespace

gl::Texture blur(const gl::Context& context, const AoInputs& inputs, gl::Texture ao, AoParams params) {
  params.blur = blur_of(params);
  if (taps_of(params.blur).count == 1) return ao;
  for (int i = 0; i < params.blur.passes; ++i) {
    if (params.blur.kind == AoBlur::xegtao) {
      ao = denoise(context, inputs, ao, i + 1 == params.blur.passes);
      continue;
    }
    ao = blur_along(context, inputs, ao, params, {1, 0});
    // Textures have the bottom row first: down is −y.
    ao = blur_along(context, inputs, ao, params, {0, -1});
  }
  return ao;
}

}  // namespace umbrameter
