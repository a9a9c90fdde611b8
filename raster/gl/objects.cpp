#include "raster/gl/objects.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "raster/gl/api.h"

namespace umbrameter::gl {
namespace {

struct FormatNames {
  GLenum internal;
  GLenum external;
  GLenum type;
  std::size_t bytes;  // of a texel as external and type give it
};

// In the order of Format.
constexpr FormatNames format_names[] = {
    {GL_R32F, GL_RED, GL_FLOAT, 4},
    {GL_RG16, GL_RG, GL_UNSIGNED_SHORT, 4},
    {GL_RG16F, GL_RG, GL_HALF_FLOAT, 4},
    {GL_RG32F, GL_RG, GL_FLOAT, 8},
    {GL_RGBA16, GL_RGBA, GL_UNSIGNED_SHORT, 8},
    {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 8},
    {GL_RGB32F, GL_RGB, GL_FLOAT, 12},
    {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16},
    {GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, 8},
    {GL_RGB32UI, GL_RGB_INTEGER, GL_UNSIGNED_INT, 12},
    {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 16},
    {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4},
    {GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_FLOAT, 4},
    {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_FLOAT, 4},
    {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 4},
};

const FormatNames& names_of(Format format) { return format_names[static_cast<std::size_t>(format)]; }

// create(1, &name) makes the name of an object of this kind.
template <class Owner, class Create>
Owner make_labelled(GLenum kind, const std::string& label, const Create& create) {
  unsigned name = 0;
  create(1, &name);
  glObjectLabel(kind, name, -1, label.c_str());
  return Owner(name);
}

Texture make_labelled_texture(GLenum target, const std::string& label) {
  return make_labelled<Texture>(GL_TEXTURE, label,
                                [&](GLsizei count, unsigned* names) { glCreateTextures(target, count, names); });
}

}  // namespace

void delete_buffer(unsigned name) { glDeleteBuffers(1, &name); }
void delete_texture(unsigned name) { glDeleteTextures(1, &name); }
void delete_framebuffer(unsigned name) { glDeleteFramebuffers(1, &name); }
void delete_vertex_array(unsigned name) { glDeleteVertexArrays(1, &name); }
void delete_shader(unsigned name) { glDeleteShader(name); }
void delete_program(unsigned name) { glDeleteProgram(name); }

Buffer make_empty_buffer(const std::string& label, std::size_t bytes) {
  constexpr std::size_t least = 16;
  Buffer buffer = make_labelled<Buffer>(GL_BUFFER, label, glCreateBuffers);
  glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(std::max(bytes, least)), nullptr, GL_DYNAMIC_STORAGE_BIT);
  return buffer;
}

void write_buffer(const Buffer& buffer, std::size_t first_byte, std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  glNamedBufferSubData(buffer.name(), static_cast<GLintptr>(first_byte), static_cast<GLsizeiptr>(bytes.size()),
                       bytes.data());
}

void read_buffer(const Buffer& buffer, std::span<std::byte> bytes) {
  if (bytes.empty()) return;
  glGetNamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

Buffer make_buffer(const std::string& label, std::span<const std::byte> bytes) {
  Buffer buffer = make_empty_buffer(label, bytes.size());
  write_buffer(buffer, 0, bytes);
  return buffer;
}

Texture make_buffer_texture(const std::string& label, Format format, const Buffer& buffer) {
  Texture texture = make_labelled_texture(GL_TEXTURE_BUFFER, label);
  glTextureBuffer(texture.name(), names_of(format).internal, buffer.name());
  return texture;
}

std::size_t texel_bytes(Format format) { return names_of(format).bytes; }

unsigned internal_format(Format format) { return static_cast<unsigned>(names_of(format).internal); }

Texture make_texture(const std::string& label, Format format, int width, int height, int layers, int levels) {
  const FormatNames names = names_of(format);
  Texture texture = make_labelled_texture(layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, label);
  const unsigned name = texture.name();
  if (layers > 0) {
    glTextureStorage3D(name, levels, names.internal, width, height, layers);
  } else {
    glTextureStorage2D(name, levels, names.internal, width, height);
  }
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, levels > 1 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

int mipmap_levels(int width, int height) {
  return static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(width, height))));
}

void compute_mipmaps(const Texture& texture) { glGenerateTextureMipmap(texture.name()); }

void write_texels(const Texture& texture, Format format, int width, int height, std::span<const std::byte> texels) {
  const FormatNames names = names_of(format);
  assert(texels.size() == names.bytes * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture.name(), 0, 0, 0, width, height, names.external, names.type, texels.data());
}

void write_layer(const Texture& texture, Format format, int layer, TextureSize size,
                 std::span<const std::byte> texels) {
  const FormatNames names = names_of(format);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage3D(texture.name(), 0, 0, 0, layer, size.width, size.height, 1, names.external, names.type,
                      texels.data());
}

Texture copy_texture(const std::string& label, const Texture& texture, Format format) {
  const TextureSize size = size_of(texture);
  Texture copy = make_texture(label, format, size.width, size.height);
  glCopyImageSubData(texture.name(), GL_TEXTURE_2D, 0, 0, 0, 0, copy.name(), GL_TEXTURE_2D, 0, 0, 0, 0, size.width,
                     size.height, 1);
  return copy;
}

void read_texels(const Texture& texture, Format format, std::span<std::byte> texels) {
  const FormatNames names = names_of(format);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  // The size is a signed int: 2 GiB and more are read without the driver's own bounds check.
  const auto bytes = static_cast<GLsizei>(std::min<std::size_t>(texels.size(), 0x7fffffff));
  glGetTextureImage(texture.name(), 0, names.external, names.type, bytes, texels.data());
}

void clear_texels(const Texture& texture, Format format) {
  const FormatNames names = names_of(format);
  glClearTexImage(texture.name(), 0, names.external, names.type, nullptr);
}

TextureSize size_of(const Texture& texture) {
  TextureSize size;
  glGetTextureLevelParameteriv(texture.name(), 0, GL_TEXTURE_WIDTH, &size.width);
  glGetTextureLevelParameteriv(texture.name(), 0, GL_TEXTURE_HEIGHT, &size.height);
  return size;
}

int depth_bits_of(const Texture& texture) {
  int bits = 0;
  glGetTextureLevelParameteriv(texture.name(), 0, GL_TEXTURE_DEPTH_SIZE, &bits);
  return bits;
}

Framebuffer make_framebuffer(const std::string& label) {
  return make_labelled<Framebuffer>(GL_FRAMEBUFFER, label, glCreateFramebuffers);
}

VertexArray make_vertex_array(const std::string& label) {
  return make_labelled<VertexArray>(GL_VERTEX_ARRAY, label, glCreateVertexArrays);
}

}  // namespace umbrameter::gl
