// One pass: its shaders declare what they read and write by name, and the pass binds by that name. No binding number is
// written down.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/math.h"
#include "raster/gl/context.h"
#include "raster/gl/objects.h"

namespace umbrameter::gl {

/// Binds textures, images, buffers and values to a program's names and runs it. Names that the program does not read
/// are ignored, so that programs which share an include share the function that binds its names. A name that the
/// program reads and that the pass does not bind is an Error (no_backend) in use() and dispatch(). What it binds must
/// outlive the last of these; buffers that are moved in live as long as the pass.
class Pass {
 public:
  /// The shaders also get the #defines of shader_interface.h.
  Pass(const Context& context, const ProgramSource& source);

  Pass& texture(const char* name, const Texture& texture) { return bind(name, {Bound::texture, texture.name()}); }
  /// To write. layered: all layers of an array.
  Pass& image(const char* name, const Texture& texture, Format format, bool layered = false);
  Pass& buffer(const char* name, const Buffer& storage) { return bind(name, {Bound::buffer, storage.name()}); }
  Pass& buffer(const char* name, Buffer&& storage) { return buffer(name, keep(std::move(storage))); }
  /// A uniform block in layout std140.
  template <class Block>
  Pass& block(const char* name, const Block& values) {
    return bind(name, {Bound::block, keep(make_block(name, values)).name()});
  }
  Pass& value(const char* name, float number);
  Pass& value(const char* name, int number);
  Pass& value(const char* name, unsigned number);
  Pass& value(const char* name, int x, int y);
  Pass& value(const char* name, const vec2& numbers);
  Pass& value(const char* name, const vec3& numbers);
  Pass& value(const char* name, const vec4& numbers);

  /// Makes the program current with all that is bound, for draws.
  void use() const;
  /// One invocation a texel of every layer, and what they wrote made visible. Checks for errors.
  void dispatch(int width, int height, int layers = 1) const;
  /// As dispatch(), that many work groups.
  void dispatch_groups(unsigned x, unsigned y = 1, unsigned z = 1) const;

 private:
  struct Bound {
    enum { nothing, value, texture, image, buffer, block } kind = nothing;
    unsigned name = 0;
    Format format = Format::r32f;  // of an image
    bool layered = false;          // likewise
  };
  Pass& bind(const char* name, const Bound& bound);
  // Where the program has the value, which counts as bound; -1 if it does not read it.
  int location(const char* name);
  const Buffer& keep(Buffer buffer);

  const Context& context_;
  std::string label_;
  const LinkedProgram& program_;
  std::vector<Bound> bound_;  // of program_.inputs
  std::vector<Buffer> kept_;
};

}  // namespace umbrameter::gl
