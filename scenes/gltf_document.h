// A glTF file between the disk and the Scene: its parsed text, its bytes, and typed accessor reads.
// Internal to scenes/gltf*.cpp; everything here throws Error (unreadable_input) naming file and object.
#pragma once

#include <array>
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

/// "mesh 3 'roof'", for messages; long names are cut.
std::string label(std::string_view kind, std::size_t index, const std::string& name);

/// Fails unless an index into `size` things of a kind is one: "it refers to mesh 7, but the file has 3".
std::size_t checked_index(int index, std::size_t size, std::string_view kind, const std::filesystem::path& path,
                          const std::string& user);

/// What reading may take in memory. A few bytes of JSON, of compressed data or of an image can ask for gigabytes, so
/// what they ask for is claimed before it is allocated. The limit is the user's, or 1 GiB and 64 times the bytes that
/// were read.
struct Allowance {
  static constexpr std::uint64_t base = std::uint64_t{1} << 30;
  static constexpr std::uint64_t multiple = 64;
  std::uint64_t input = 0;                       ///< bytes of the file and of the files that it refers to
  std::optional<std::uint64_t> limit_of_user{};  ///< bytes
  std::uint64_t claimed = 0;                     ///< bytes

  std::uint64_t limit() const { return limit_of_user.value_or(base + multiple * input); }
};
void claim(Allowance& allowance, std::uint64_t bytes, const std::filesystem::path& path, const std::string& object);
/// The same, where `scratch` further bytes must fit that are held only while this is decoded.
void claim_with_scratch(Allowance& allowance, std::uint64_t bytes, std::uint64_t scratch,
                        const std::filesystem::path& path, const std::string& object);

Bytes read_file(const std::filesystem::path& path, const std::string& object);

/// The two parts of a file, in its bytes: JSON text, and the binary chunk that only a .glb has.
struct Container {
  std::string_view json;
  std::optional<std::span<const unsigned char>> binary;
};
Container split_container(std::span<const unsigned char> file, const std::filesystem::path& path);

/// The two parts as one .glb. Throws Error (partial) beyond the 4 GiB that its header can say.
Bytes join_container(std::string json, const Bytes& binary);

/// Why read_uri() cannot read it: it leaves the scene's folder, or there is no such file. Empty where it can be opened.
std::string objection_to_uri(const std::filesystem::path& scene_path, const std::string& uri);

/// The bytes behind a data URI, or behind a relative path that stays within the folder of the scene's file.
Bytes read_uri(const std::filesystem::path& scene_path, const std::string& object, const std::string& uri);

struct BufferSource {
  std::optional<std::string> uri;
  std::optional<std::uint64_t> byte_length;
  bool is_fallback = false;  ///< of a meshopt compression: a stand-in without bytes
};
struct ImageSource {
  std::string name;
  std::optional<std::string> uri;
  int buffer_view = -1;
};

/// The two names of one extension.
inline constexpr std::array<const char*, 2> meshopt_names = {"KHR_meshopt_compression", "EXT_meshopt_compression"};

/// The parsed text. Buffers and images are kept apart from the parser, which would open files by itself.
struct Document {
  std::filesystem::path path;
  std::shared_ptr<tinygltf::Model> model;
  std::vector<BufferSource> buffers;
  std::vector<ImageSource> images;
  std::optional<std::span<const unsigned char>> binary;  ///< in the file's bytes, which must outlive this
  int no_view = 0;                                       ///< Accessor::bufferView of one that has none
  bool is_animated = false;
};
Document parse_document(const std::filesystem::path& path, const Container& container, Allowance& allowance);

/// Bytes of buffers and buffer views, read or decompressed when first asked for.
struct BufferStore {
  const Document& document;
  Allowance& allowance;
  std::vector<std::optional<Bytes>> buffers;
  std::vector<std::optional<Bytes>> decoded_views;
};
BufferStore make_buffer_store(const Document& document, Allowance& allowance);
std::span<const unsigned char> view_bytes(BufferStore& store, int buffer_view, const std::string& user);

/// `length` bytes from `offset`; fails, naming the object, where they lie beyond the end.
std::span<const unsigned char> part(std::span<const unsigned char> bytes, std::uint64_t offset, std::uint64_t length,
                                    const std::filesystem::path& path, const std::string& object);

/// Decodes one buffer view of a meshopt compression, whose size it claims. `object` names it in errors.
struct MeshoptView {
  std::uint64_t count = 0;
  std::uint64_t stride = 0;
  std::string mode;
  std::string filter;
};
Bytes decode_meshopt(const MeshoptView& view, std::span<const unsigned char> encoded, Allowance& allowance,
                     const std::filesystem::path& path, const std::string& object);

/// All elements of an accessor as glm vectors (float, vec2 to vec4) or mat4: sparse values put in, normalised integers
/// mapped to [0, 1] or [-1, 1] (glTF 2.0, sections 3.6.2.2 and 3.6.2.3). An accessor without bytes is zero.
template <class Element>
std::vector<Element> read_elements(BufferStore& store, int accessor, const std::string& user);
std::vector<std::uint32_t> read_indices(BufferStore& store, int accessor, const std::string& user);

enum class ImageFormat { png, jpeg, webp, ktx2, dds, unknown };
/// By its first bytes.
ImageFormat format_of_image(std::span<const unsigned char> bytes);

/// PNG or JPEG to RGBA8. Claims the texels before it unpacks them.
Image<glm::u8vec4> decode_image(std::span<const unsigned char> bytes, Allowance& allowance,
                                const std::filesystem::path& path, const std::string& object);
Bytes encode_png(const Image<glm::u8vec4>& image);

}  // namespace umbrameter::gltf
