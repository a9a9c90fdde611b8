// Compression of the images in PNG and PDF files and in the page.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace umbrameter {

/// Against fast, small takes half as much time again and saves 3 to 10 per cent; levels above it take several times as
/// long for 2 per cent more.
enum class DeflateLevel { fast = 2, small = 6 };

/// The bytes as a zlib stream (RFC 1950), the same on every machine.
std::string deflate(std::string_view bytes, DeflateLevel level = DeflateLevel::fast);

/// The `size` bytes of a zlib stream. Throws std::runtime_error if it is damaged or holds another number of bytes.
std::string inflate(std::string_view stream, std::size_t size);

}  // namespace umbrameter
