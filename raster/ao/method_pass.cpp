#include "raster/ao/method_pass.h"

#include <span>
#include <string>
#include <utility>

#include "raster/gbuffer/view_block.h"
#include "raster/gl/pass.h"

namespace umbrameter {
namespace {

// The size of a block in layout std140 is a multiple of 16 bytes.
template <class Settings>
struct alignas(16) SettingsBlock {
  Settings settings;
};

// A texture and the name and format of the image in the shader that writes it.
struct Drawn {
  gl::Texture texture;
  const char* name;
  gl::Format format;
  std::string defines{};
};

template <class Technique>
gl::Texture run(const gl::Context& context, const AoInputs& inputs, const char* shader, const Technique& technique,
                Drawn drawn) {
  const std::vector<vec4> noise = noise_of(technique, inputs.seed);
  const ivec2 size = ao_image_size(inputs);
  gl::Pass pass(context, {{shader}, resolution_defines(inputs.resolution) + drawn.defines});
  bind(pass, inputs)
      .block("View", make_view_block(inputs.view))
      .block("Settings", SettingsBlock<decltype(settings_of(technique))>{settings_of(technique)})
      .buffer("Noise", gl::make_buffer("ao noise", std::span<const vec4>(noise)))
      .value("noise_size", technique.noise.size)
      .image(drawn.name, drawn.texture, drawn.format)
      .dispatch(size.x, size.y);
  return std::move(drawn.texture);
}

template <class Technique>
gl::Texture run(const gl::Context& context, const AoInputs& inputs, const char* shader, const Technique& technique) {
  return run(context, inputs, shader, technique, {make_ao_image("ao", inputs), "ao_image", gl::Format::r32f});
}

template <class Technique>
gl::Texture run_bent(const gl::Context& context, const AoInputs& inputs, const char* shader,
                     const Technique& technique) {
  const ivec2 size = ao_image_size(inputs);
  return run(context, inputs, shader, technique,
             {gl::make_texture("bent normals", gl::Format::rgba32f, size.x, size.y), "bent_normals",
              gl::Format::rgba32f, "#define AO_BENT_NORMAL\n"});
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

gl::Texture draw_bent_normals(const gl::Context& context, const AoInputs& inputs, const Gtao& technique) {
  return run_bent(context, inputs, "gtao.comp", technique);
}

gl::Texture draw_bent_normals(const gl::Context& context, const AoInputs& inputs, const Bitmask& technique) {
  return run_bent(context, inputs, "bitmask.comp", technique);
}

}  // namespace umbrameter
