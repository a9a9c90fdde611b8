// Move-only owners of OpenGL names, and how they are made. No state is cached here.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>

namespace umbrameter::gl {

/// Owns one OpenGL name; 0 is empty and needs no context. What it owns is deleted in the current context.
template <void (*destroy)(unsigned)>
class Object {
 public:
  Object() = default;
  explicit Object(unsigned name) : name_(name) {}
  ~Object() { reset(); }
  Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0u)) {}
  Object& operator=(Object&& other) noexcept {
    if (this != &other) {
      reset();
      name_ = std::exchange(other.name_, 0u);
    }
    return *this;
  }

  unsigned name() const { return name_; }
  bool empty() const { return name_ == 0; }
  void reset() {
    if (name_ != 0) destroy(std::exchange(name_, 0u));
  }

 private:
  unsigned name_ = 0;
};

void delete_buffer(unsigned name);
void delete_texture(unsigned name);
void delete_framebuffer(unsigned name);
void delete_vertex_array(unsigned name);
void delete_shader(unsigned name);
void delete_program(unsigned name);

using Buffer = Object<&delete_buffer>;
using Texture = Object<&delete_texture>;
using Framebuffer = Object<&delete_framebuffer>;
using VertexArray = Object<&delete_vertex_array>;
using Shader = Object<&delete_shader>;
using Program = Object<&delete_program>;

/// Immutable contents; zero bytes give a buffer of the least size, never an error.
Buffer make_buffer(const std::string& label, std::span<const std::byte> bytes);

template <class T>
Buffer make_buffer(const std::string& label, std::span<const T> values) {
  return make_buffer(label, std::as_bytes(values));
}

/// Room that write_buffer() fills; its contents are undefined until then.
Buffer make_empty_buffer(const std::string& label, std::size_t bytes);

/// Replaces a part of a buffer, which must have room for it.
void write_buffer(const Buffer& buffer, std::size_t first_byte, std::span<const std::byte> bytes);

/// A uniform block of one value.
template <class Block>
Buffer make_block(const std::string& label, const Block& block) {
  return make_buffer(label, std::as_bytes(std::span<const Block, 1>(&block, 1)));
}

enum class Format {
  r32f,
  rg16,
  rg16f,
  rg32f,
  rgba16,
  rgba16f,
  rgb32f,
  rgba32f,
  rg32ui,
  rgb32ui,
  rgba32ui,
  rgba8,
  depth16,
  depth24,
  depth32f
};

/// Bytes of one texel.
std::size_t texel_bytes(Format format);

/// OpenGL's number of the format.
unsigned internal_format(Format format);

/// A buffer as texels for samplerBuffer and usamplerBuffer: r32f, rgb32f, rgba32f, rg32ui and rgb32ui. It keeps the
/// buffer's memory alive.
Texture make_buffer_texture(const std::string& label, Format format, const Buffer& buffer);

/// Nearest filter, clamped to the edge; layers 0 is a plain 2D texture, else a 2D array.
Texture make_texture(const std::string& label, Format format, int width, int height, int layers = 0, int levels = 1);

/// Levels down to one texel.
int mipmap_levels(int width, int height);

/// Computes all levels from the first: each texel is the mean of four, if the sides are even.
void compute_mipmaps(const Texture& texture);

struct TextureSize {
  int width = 0;
  int height = 0;
};

/// Replaces all texels of a plain 2D texture; rows from texture row 0 on, tightly packed.
void write_texels(const Texture& texture, Format format, int width, int height, std::span<const std::byte> texels);

/// Replaces a layer of an array, as write_texels() does a plain texture.
void write_layer(const Texture& texture, Format format, int layer, TextureSize size, std::span<const std::byte> texels);

/// A plain 2D texture with the same texels.
Texture copy_texture(const std::string& label, const Texture& texture, Format format);

/// Sets every texel to 0.
void clear_texels(const Texture& texture, Format format);

/// What shaders have written to a buffer; `bytes` is no longer than the buffer.
void read_buffer(const Buffer& buffer, std::span<std::byte> bytes);

/// All texels of all layers, rows from texture row 0 on, tightly packed; `texels` has the size of all of them.
void read_texels(const Texture& texture, Format format, std::span<std::byte> texels);

TextureSize size_of(const Texture& texture);

/// Bits of the depth that the driver stores; a driver may choose more than the format asks for.
int depth_bits_of(const Texture& texture);

Framebuffer make_framebuffer(const std::string& label);
VertexArray make_vertex_array(const std::string& label);

}  // namespace umbrameter::gl
