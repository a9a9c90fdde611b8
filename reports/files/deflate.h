// Compression of the images in PNG and PDF files and in the page.
#pragma once

#include <string>
#include <string_view>

namespace umbrameter {

/// Against fast, small takes half as much time again and saves 3 to 10 per cent; levels above it take several times as
/// long for 2 per cent more.
enum class DeflateLevel { fast = 2, small = 6 };

/// The bytes as a zlib stream (RFC 1950), the same on every machine.
std::string deflate(std::string_view bytes, DeflateLevel level = DeflateLevel::fast);

}  // namespace umbrameter
