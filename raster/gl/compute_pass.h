// One compute pass: its shader declares what it reads and writes by name, and the pass binds by that name. No binding
// number is written down twice.
#pragma once

#include <string>

#include "raster/gl/context.h"
#include "raster/gl/objects.h"

namespace umbrameter::gl {

/// Binds textures, images and values to a program's uniforms and runs it. A name that the shader does not declare, or
/// that its compiler dropped as unused, is an Error (no_backend).
class ComputePass {
 public:
  /// GROUP_SIZE and NO_ID are defined for the shader, besides `defines`.
  ComputePass(const Context& context, const std::string& file, const std::string& defines = {});

  ComputePass& texture(const char* name, const Texture& texture);
  /// All layers of an array; `layered` false: a plain 2D texture.
  ComputePass& image(const char* name, const Texture& texture, Format format, bool layered = false);
  ComputePass& value(const char* name, float number);
  ComputePass& value(const char* name, int number);
  ComputePass& value(const char* name, int x, int y);

  /// One invocation a texel of every layer, and what they wrote made visible. Checks for errors.
  void dispatch(int width, int height, int layers = 1);

 private:
  int location(const char* name) const;

  const Context& context_;
  std::string file_;
  const Program& program_;
  // Fixed bindings (shader_interface.h) use the units below.
  unsigned next_texture_ = 16;
  unsigned next_image_ = 0;
};

}  // namespace umbrameter::gl
