// Puts glTF files together in memory, piece by piece: a writer for tests, apart from the one of scenes/.
// It checks nothing, so that broken files can be written as well.
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace umbrameter::test {

using Bytes = std::vector<unsigned char>;

template <class T>
Bytes raw_bytes(const std::vector<T>& values) {
  Bytes bytes(values.size() * sizeof(T));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// One file in the making. Every piece is its JSON text; the lists are the arrays of the root object.
struct GltfBuilder {
  Bytes binary;  ///< of buffer 0
  std::map<std::string, std::vector<std::string>> lists;
  std::vector<std::string> extensions_used;
  std::vector<std::string> extensions_required;
  std::string more;  ///< further members of the root object, each with a comma before it
};

/// Appends to a list of the root, such as "nodes"; returns the index of the new item.
int add(GltfBuilder& builder, const std::string& list, const std::string& json);

/// Appends bytes to buffer 0, at a multiple of 4; returns where they start.
std::size_t add_bytes(GltfBuilder& builder, const Bytes& bytes);

/// A buffer view of these bytes. `more` are further members, each with a comma before it.
int add_view(GltfBuilder& builder, const Bytes& bytes, const std::string& more = "");

int component_type(std::string_view name);  ///< of "i8", "u8", "i16", "u16", "u32" or "f32", as glTF numbers them

/// An accessor over a view. `type` is "SCALAR", "VEC3" and so on.
int add_accessor(GltfBuilder& builder, int view, std::string_view component, std::string_view type, std::size_t count,
                 const std::string& more = "");

int components_of(std::string_view type);

template <class T>
std::string_view component_name() {
  if constexpr (std::is_same_v<T, float>) return "f32";
  if constexpr (std::is_same_v<T, std::int8_t>) return "i8";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "u8";
  if constexpr (std::is_same_v<T, std::int16_t>) return "i16";
  if constexpr (std::is_same_v<T, std::uint16_t>) return "u16";
  if constexpr (std::is_same_v<T, std::uint32_t>) return "u32";
}

/// A view and an accessor of these values. Vectors are kept at multiples of 4 bytes, as vertex attributes must be.
template <class T>
int add_values(GltfBuilder& builder, std::string_view type, const std::vector<T>& values,
               const std::string& more = "") {
  const auto components = static_cast<std::size_t>(components_of(type));
  const std::size_t tight = components * sizeof(T);
  const std::size_t stride = components == 1 ? tight : (tight + 3) / 4 * 4;
  const std::size_t count = values.size() / components;
  Bytes bytes(count * stride);
  for (std::size_t i = 0; i < count; ++i) std::memcpy(&bytes[i * stride], &values[i * components], tight);
  const int view = add_view(builder, bytes, stride == tight ? "" : ",\"byteStride\":" + std::to_string(stride));
  return add_accessor(builder, view, component_name<T>(), type, count, more);
}

/// The root object; `buffer_uri`, where there is one, is that of buffer 0.
std::string to_json(const GltfBuilder& builder, const std::string& buffer_uri = "");

Bytes to_binary_gltf(const GltfBuilder& builder);
/// Text with the buffer in a data URI.
Bytes to_text_gltf(const GltfBuilder& builder);
/// A GLB of any two chunks.
Bytes pack_glb(std::string json, Bytes binary);

std::string base64(const Bytes& bytes);
std::string data_uri(std::string_view media_type, const Bytes& bytes);
std::string join(const std::vector<std::string>& items);  ///< with commas

/// 8-bit RGBA, four bytes a texel, top row first (PNG specification, third edition; deflate without compression).
Bytes png(int width, int height, const Bytes& rgba);
/// A grey image whose 8×8 blocks have one value each, top row of blocks first (ITU-T T.81, baseline sequential).
Bytes grey_jpeg(int blocks_across, int blocks_down, const Bytes& values);
/// A JPEG's segment for a Huffman table with `codes` codes of each of the 16 lengths.
Bytes huffman_table(unsigned char codes);

}  // namespace umbrameter::test
