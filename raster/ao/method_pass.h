// The methods whose text shaders and processor share (techniques/ao/*.glsl).
#pragma once

#include <cstddef>
#include <cstring>
#include <string_view>
#include <vector>

#include "raster/ao/ao_inputs.h"
#include "raster/gl/context.h"
#include "techniques/ao/technique.h"

namespace umbrameter {

struct AoMethod {
  std::string_view text;            ///< its file
  std::string_view settings_name;   ///< of the struct in the text
  std::vector<std::byte> settings;  ///< numbers of 32 bits
  std::vector<vec4> noise;          ///< noise_size × noise_size
  int noise_size = 1;
};

template <class Technique>
AoMethod method_of(const Technique& technique, std::uint32_t seed) {
  const auto settings = settings_of(technique);
  AoMethod method{technique.text, technique.settings, {}, noise_of(technique, seed), technique.noise.size};
  method.settings.resize(sizeof(settings));
  std::memcpy(method.settings.data(), &settings, sizeof(settings));
  return method;
}

/// Accessibility before the blur, 1 on background, R32F.
gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const AoMethod& method);

/// The mean open direction by the method: unit, world space; 0 on background and if no direction is open. RGBA32F.
gl::Texture draw_bent_normals(const gl::Context& context, const AoInputs& inputs, const AoMethod& method);

}  // namespace umbrameter
