#include "raster/ao/method_pass.h"

#include <span>

#include "raster/gbuffer/view_block.h"
#include "raster/gl/pass.h"

namespace umbrameter {
namespace {

// The size of a block in layout std140 is a multiple of 16 bytes.
template <class Settings>
struct alignas(16) SettingsBlock {
  Settings settings;
};

template <class Technique>
gl::Texture run(const gl::Context& context, const AoInputs& inputs, const char* shader, const Technique& technique) {
  const std::vector<vec4> noise = noise_of(technique, inputs.seed);
  gl::Texture ao = make_ao_image("ao", inputs);
  const ivec2 size = ao_image_size(inputs);
  gl::Pass pass(context, {{shader}, resolution_defines(inputs.resolution)});
  bind(pass, inputs)
      .block("View", make_view_block(inputs.view))
      .block("Settings", SettingsBlock<decltype(settings_of(technique))>{settings_of(technique)})
      .buffer("Noise", gl::make_buffer("ao noise", std::span<const vec4>(noise)))
      .value("noise_size", technique.noise.size)
      .image("ao_image", ao, gl::Format::r32f)
      .dispatch(size.x, size.y);
  return ao;
}

}  // namespace

gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Gtao& technique) {
  return run(context, inputs, "gtao.comp", technique);
}

gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Hbao& technique) {
  return run(context, inputs, "hbao.comp", technique);
}

gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Alchemy& technique) {
  return run(context, inputs, "alchemy.comp", technique);
}

gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Crytek& technique) {
  return run(context, inputs, "crytek.comp", technique);
}

gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Bitmask& technique) {
  return run(context, inputs, "bitmask.comp", technique);
}

gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Marched& technique) {
  return run(context, inputs, "marched.comp", technique);
}

}  // namespace umbrameter
