#include "scenes/gltf_document.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_FAILURE_USERMSG
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image.h>
#include <stb_image_write.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>

namespace umbrameter::gltf {
namespace {

// ITU-T T.81, section B.2.4.2: a Huffman table has at most 256 codes. The decoder writes as many as the file says, and
// reads a table to its end even where the segment of that length ends before.
bool are_tables_sane(std::span<const unsigned char> bytes, std::size_t length) {
  constexpr std::size_t head = 17;
  for (std::size_t at = 0; at < length;) {
    const auto rest = bytes.subspan(std::min(at + 1, bytes.size()));
    const auto counts = rest.first(std::min(head - 1, rest.size()));
    const std::size_t codes = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
    if (codes > 256) return false;
    at += head + codes;
  }
  return true;
}

struct JpegProperties {
  bool has_sane_tables = true;
  bool is_progressive = false;
};

// Walks the segments of a JPEG, those between its scans as well, to the end of the image, where the decoder stops too.
JpegProperties examine_jpeg(std::span<const unsigned char> bytes) {
  JpegProperties found;
  if (bytes.empty() || bytes[0] != 0xff) return found;
  std::size_t at = 0;
  while (at + 3 < bytes.size()) {
    const unsigned marker = bytes[at] == 0xff ? bytes[at + 1] : 0u;
    if (marker == 0xd9) return found;
    const bool is_alone = marker <= 0x01 || (marker >= 0xd0 && marker <= 0xd8) || marker == 0xff;
    if (is_alone) {
      ++at;
      continue;
    }
    const std::size_t length = (std::size_t{bytes[at + 2]} << 8u) | bytes[at + 3];
    const std::size_t end = at + 2 + std::max<std::size_t>(length, 2);
    found.is_progressive |= marker == 0xc2;
    if (marker == 0xc4 && !are_tables_sane(bytes.subspan(at + 4), end - at - 4)) found.has_sane_tables = false;
    at = end;
  }
  return found;
}

// What the decoder holds at its peak beside the texels that are kept, bytes a texel. All formats: its own result, of
// which ours is a copy. Progressive JPEG: three planes of 8-bit samples and of 16-bit coefficients before that. 16-bit
// PNG: the unfiltered and the unpacked rows.
std::uint64_t scratch_per_texel(std::span<const unsigned char> bytes, const JpegProperties& jpeg) {
  if (jpeg.is_progressive) return 9;
  return stbi_is_16_bit_from_memory(bytes.data(), static_cast<int>(bytes.size())) != 0 ? 12 : 4;
}

bool starts_with(std::span<const unsigned char> bytes, std::size_t offset, std::string_view text) {
  return bytes.size() >= offset + text.size() && std::memcmp(&bytes[offset], text.data(), text.size()) == 0;
}

}  // namespace

ImageFormat format_of_image(std::span<const unsigned char> bytes) {
  if (starts_with(bytes, 0, "\x89PNG")) return ImageFormat::png;
  if (starts_with(bytes, 0, "\xff\xd8") || starts_with(bytes, 0, "\xff\xff")) return ImageFormat::jpeg;
  if (starts_with(bytes, 0, "RIFF") && starts_with(bytes, 8, "WEBP")) return ImageFormat::webp;
  if (starts_with(bytes, 0, "\xabKTX 20\xbb")) return ImageFormat::ktx2;
  if (starts_with(bytes, 0, "DDS ")) return ImageFormat::dds;
  return ImageFormat::unknown;
}

Image<glm::u8vec4> decode_image(std::span<const unsigned char> bytes, Allowance& allowance,
                                const std::filesystem::path& path, const std::string& object) {
  constexpr int max_side = 32768;
  constexpr std::int64_t max_texels = std::int64_t{1} << 28;
  const std::string remedy = "store the image as PNG or JPEG";
  if (bytes.empty() || bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    fail(path, object, "it holds " + std::to_string(bytes.size()) + " bytes", remedy);
  }
  const JpegProperties jpeg = examine_jpeg(bytes);
  if (!jpeg.has_sane_tables) fail(path, object, "its JPEG has a Huffman table of more than 256 codes", remedy);
  const int size = static_cast<int>(bytes.size());
  int width = 0;
  int height = 0;
  int channels = 0;
  if (stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0) {
    fail(path, object, std::string("it cannot be read as PNG or JPEG (") + stbi_failure_reason() + ")", remedy);
  }
  if (width < 1 || height < 1 || width > max_side || height > max_side || std::int64_t{width} * height > max_texels) {
    fail(path, object, "it is " + std::to_string(width) + "x" + std::to_string(height) + " texels large",
         "make the image smaller");
  }
  const std::uint64_t texel_count = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  claim_with_scratch(allowance, sizeof(glm::u8vec4) * texel_count, scratch_per_texel(bytes, jpeg) * texel_count, path,
                     object + " of " + std::to_string(width) + "x" + std::to_string(height) + " texels");
  const std::unique_ptr<unsigned char, void (*)(void*)> texels(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4), &stbi_image_free);
  if (texels == nullptr) {
    fail(path, object, std::string("it cannot be decoded (") + stbi_failure_reason() + ")", remedy);
  }
  Image<glm::u8vec4> image(width, height);
  std::memcpy(image.pixels.data(), texels.get(), image.size() * sizeof(glm::u8vec4));
  return image;
}

Bytes encode_png(const Image<glm::u8vec4>& image) {
  Bytes bytes;
  const auto append = [](void* target, void* data, int size) {
    const auto* first = static_cast<const unsigned char*>(data);
    auto& out = *static_cast<Bytes*>(target);
    out.insert(out.end(), first, first + size);
  };
  stbi_write_png_to_func(append, &bytes, image.width, image.height, 4, image.pixels.data(), image.width * 4);
  return bytes;
}

}  // namespace umbrameter::gltf
