#include "raster/ao/method_pass.h"

#include <span>
#include <string>

#include "raster/gbuffer/view_block.h"
#include "raster/gl/pass.h"

namespace umbrameter {
namespace {

gl::Pass method_pass(const gl::Context& context, const AoInputs& inputs, const AoMethod& method,
                     const std::string& defines = {}) {
  gl::Pass pass(context,
                {{"ao_method.comp"},
                 "#define TECHNIQUE_TEXT " + std::string(method.text) + "\n#define METHOD_SETTINGS " +
                     std::string(method.settings_name) + "\n" + resolution_defines(inputs.resolution) + defines});
  bind(pass, inputs)
      .block("View", make_view_block(inputs.view))
      .buffer("MethodSettings", gl::make_buffer("ao settings", method.settings))
      .buffer("Noise", gl::make_buffer("ao noise", std::span<const vec4>(method.noise)))
      .value("noise_size", method.noise_size);
  return pass;
}

}  // namespace

gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const AoMethod& method) {
  const ivec2 size = ao_image_size(inputs);
  gl::Texture ao = make_ao_image("ao", inputs);
  method_pass(context, inputs, method).image("ao_image", ao, gl::Format::r32f).dispatch(size.x, size.y);
  return ao;
}

gl::Texture draw_bent_normals(const gl::Context& context, const AoInputs& inputs, const AoMethod& method) {
  const ivec2 size = ao_image_size(inputs);
  gl::Texture bent = gl::make_texture("bent normals", gl::Format::rgba32f, size.x, size.y);
  method_pass(context, inputs, method, "#define AO_BENT_NORMAL\n")
      .image("bent_normals", bent, gl::Format::rgba32f)
      .dispatch(size.x, size.y);
  return bent;
}

}  // namespace umbrameter
