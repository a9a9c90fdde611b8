// A glTF file between the disk and the Scene: its parsed text, its bytes, and typed accessor reads.
// Internal to scenes/gltf*.cpp; everything here throws Error (unreadable_input) naming file and object.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"
#include "core/math.h"

namespace tinygltf {
class Model;
}

namespace umbrameter::gltf {

using Bytes = std::vector<unsigned char>;

/// "file: object: why; remedy".
[[noreturn]] void fail(const std::filesystem::path& path, const std::string& object, const std::string& why,
                       const std::string& remedy = "export it again, or find the fault with the glTF validator");

Bytes read_file(const std::filesystem::path& path, const std::string& object);

/// The two parts of a file, in its bytes: JSON text, and the binary chunk that only a .glb has.
struct Container {
  std::string_view json;
  std::optional<std::span<const unsigned char>> binary;
};
Container split_container(std::span<const unsigned char> file, const std::filesystem::path& path);

/// The bytes behind a data URI, or behind a relative path that stays within the folder of the scene's file.
Bytes read_uri(const std::filesystem::path& scene_path, const std::string& object, const std::string& uri);

struct BufferSource {
  std::optional<std::string> uri;
  std::uint64_t byte_length = 0;
  bool is_fallback = false;  ///< EXT_meshopt_compression: a stand-in without bytes
};
struct ImageSource {
  std::string name;
  std::optional<std::string> uri;
  int buffer_view = -1;
};

/// The parsed text. Buffers and images are kept apart from the parser, which would open files by itself.
struct Document {
  std::filesystem::path path;
  std::shared_ptr<tinygltf::Model> model;
  std::vector<BufferSource> buffers;
  std::vector<ImageSource> images;
  std::optional<std::span<const unsigned char>> binary;  ///< in the file's bytes, which must outlive this
  bool is_animated = false;                              ///< has animations or skins, which are left out
};
Document parse_document(const std::filesystem::path& path, const Container& container);

/// Bytes of buffers and buffer views, read or decompressed when first asked for.
struct BufferStore {
  const Document* document = nullptr;
  std::vector<std::optional<Bytes>> buffers;
  std::vector<std::optional<Bytes>> decoded_views;
};
BufferStore make_buffer_store(const Document& document);
std::span<const unsigned char> view_bytes(BufferStore& store, int buffer_view, const std::string& user);

/// Decodes one EXT_meshopt_compression buffer view. `object` names it in errors.
struct MeshoptView {
  std::uint64_t count = 0;
  std::uint64_t stride = 0;
  std::string mode;
  std::string filter;
};
Bytes decode_meshopt(const MeshoptView& view, std::span<const unsigned char> encoded, const std::filesystem::path& path,
                     const std::string& object);

/// All elements of an accessor, normalised integers mapped to [0, 1] or [-1, 1]. `components` is what is asked for.
std::vector<float> read_floats(BufferStore& store, int accessor, std::size_t components, const std::string& user);
std::vector<std::uint32_t> read_indices(BufferStore& store, int accessor, const std::string& user);

/// PNG or JPEG to RGBA8.
Image<glm::u8vec4> decode_image(std::span<const unsigned char> bytes, const std::filesystem::path& path,
                                const std::string& object);
Bytes encode_png(const Image<glm::u8vec4>& image);

}  // namespace umbrameter::gltf
