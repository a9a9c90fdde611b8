// One pass. Its shaders declare by name what they read and write, and the pass binds by that name, so that no code
// holds binding numbers.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/math.h"
#include "raster/gl/context.h"
#include "raster/gl/objects.h"

namespace umbrameter::gl {

/// Binds textures, images, buffers and values to a program's names and runs it. Names that the program does not read
/// are ignored, so that programs which share an include share the function that binds its names. use() and dispatch()
/// throw Error (no_backend) if the program reads a name to which nothing is bound. Bound objects must outlive the last
/// draw or dispatch; buffers that are moved in live as long as the pass.
class Pass {
 public:
  /// The shaders also get the #defines of shader_interface.h.
  Pass(const Context& context, const ProgramSource& source);

  Pass& texture(const char* name, const Texture& texture) { return bind(name, {Bound::Kind::texture, texture.name()}); }
  /// An image that the shader writes: a level of the texture. layered: binds all layers of an array.
  Pass& image(const char* name, const Texture& texture, Format format, bool layered = false, int level = 0);
  Pass& buffer(const char* name, const Buffer& storage) { return bind(name, {Bound::Kind::buffer, storage.name()}); }
  Pass& buffer(const char* name, Buffer&& storage) { return buffer(name, keep(std::move(storage))); }
  /// A uniform block in layout std140.
  template <class Block>
  Pass& block(const char* name, const Block& values) {
    return bind(name, {Bound::Kind::block, keep(make_block(name, values)).name()});
  }
  Pass& value(const char* name, float x);
  Pass& value(const char* name, int x);
  Pass& value(const char* name, unsigned x);
  Pass& value(const char* name, int x, int y);
  Pass& value(const char* name, const vec2& v);
  Pass& value(const char* name, const vec3& v);
  Pass& value(const char* name, const vec4& v);

  /// Makes the program and everything bound to it current, for draws.
  void use() const;
  /// Runs one invocation per texel of each layer, makes their writes visible and checks for errors.
  void dispatch(int width, int height, int layers = 1) const;
  /// Like dispatch(), with this number of work groups.
  void dispatch_groups(unsigned x, unsigned y = 1, unsigned z = 1) const;

 private:
  struct Bound {
    enum class Kind { nothing, value, texture, image, buffer, block };
    Kind kind = Kind::nothing;
    unsigned name = 0;
    Format format = Format::r32f;  // images only
    bool layered = false;          // images only
    int level = 0;                 // images only
  };
  Pass& bind(const char* name, const Bound& bound);
  // The location of a uniform, or -1 if the program does not read it. Marks it as bound.
  int location(const char* name);
  template <class SetUniform, class... Number>
  Pass& set(const char* name, SetUniform set_uniform, Number... numbers);
  const Buffer& keep(Buffer buffer);

  const Context& context_;
  std::string label_;
  const LinkedProgram& program_;
  std::vector<Bound> bound_;  // parallel to program_.inputs
  std::vector<Buffer> kept_;
};

/// Makes the writes of draws and dispatches visible to texture fetches, storage buffers and read-backs.
void make_writes_visible();

}  // namespace umbrameter::gl
