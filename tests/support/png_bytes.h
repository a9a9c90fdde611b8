// PNG files of any kind, byte by byte: bit depth, colour type and chunks that the program's own writer never uses.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "reports/files/deflate.h"

namespace umbrameter {

/// Most significant byte first.
inline std::string big_endian(std::uint32_t value, unsigned bytes = 4) {
  std::string text;
  for (unsigned i = bytes; i > 0; --i) text += static_cast<char>(value >> 8u * (i - 1) & 0xffu);
  return text;
}

/// A chunk with its length and CRC (PNG specification, annex D).
inline std::string png_chunk(std::string_view name, std::string_view data) {
  std::uint32_t crc = 0xffffffffu;
  const std::string body = std::string(name) + std::string(data);
  for (const char c : body) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1u ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
  }
  return big_endian(static_cast<std::uint32_t>(data.size())) + body + big_endian(~crc);
}

/// `rows` are uncompressed, each behind the number of its filter; `chunks` stand before the pixels. Colour types: 0
/// grey, 2 RGB, 4 grey with alpha, 6 RGB with alpha.
inline std::string png_bytes(std::uint32_t width, std::uint32_t height, char bit_depth, char color_type,
                             std::string_view rows, const std::string& chunks = {}) {
  return "\x89PNG\r\n\x1a\n" +
         png_chunk("IHDR", big_endian(width) + big_endian(height) + bit_depth + color_type + std::string(3, '\0')) +
         chunks + png_chunk("IDAT", deflate(rows)) + png_chunk("IEND", "");
}

}  // namespace umbrameter
