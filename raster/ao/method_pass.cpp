#include <span>
#include <string>

#include "raster/ao/ao_passes.h"
#include "raster/ao/ssao_pass.h"
#include "raster/gbuffer/view_block.h"
#include "raster/gl/pass.h"

namespace umbrameter {
namespace {

template <class Technique>
gl::Pass method_pass(const gl::Context& context, const AoInputs& inputs, const Technique& technique,
                     const std::string& defines = {}) {
  const auto settings = settings_of(technique);
  const std::vector<vec4> noise = noise_of(technique, inputs.seed);
  gl::Pass pass(context,
                {{"ao_method.comp"},
                 "#define TECHNIQUE_TEXT " + std::string(technique.text) + "\n#define METHOD_SETTINGS " +
                     std::string(technique.settings) + "\n" + resolution_defines(inputs.resolution) + defines});
  bind(pass, inputs)
      .block("View", make_view_block(inputs.view))
      .buffer("MethodSettings", gl::make_buffer("ao settings", std::as_bytes(std::span(&settings, 1))))
      .buffer("Noise", gl::make_buffer("ao noise", std::span(noise)))
      .value("noise_size", technique.noise.size);
  return pass;
}

}  // namespace

gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const AoTechnique& technique) {
  const auto draw_of = [&]<class T>(const T& each) {
    if constexpr (std::is_same_v<T, Ssao>) {
      return draw(context, inputs, each);
    } else {
      const ivec2 size = ao_image_size(inputs);
      gl::Texture ao = make_ao_image("ao", inputs);
      method_pass(context, inputs, each).image("ao_image", ao, gl::Format::r32f).dispatch(size.x, size.y);
      return ao;
    }
  };
  return std::visit(draw_of, technique);
}

std::optional<gl::Texture> draw_bent_normals(const gl::Context& context, const AoInputs& inputs,
                                             const AoTechnique& technique) {
  const auto draw_of = [&](const auto& each) -> std::optional<gl::Texture> {
    if constexpr (requires { each.has_bent_normal; }) {
      const ivec2 size = ao_image_size(inputs);
      gl::Texture bent = gl::make_texture("bent normals", gl::Format::rgba32f, size.x, size.y);
      method_pass(context, inputs, each, "#define AO_BENT_NORMAL\n")
          .image("bent_normals", bent, gl::Format::rgba32f)
          .dispatch(size.x, size.y);
      return bent;
    }
    return {};
  };
  return std::visit(draw_of, technique);
}

}  // namespace umbrameter
