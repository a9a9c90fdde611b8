// Compression of the images in PNG and PDF files and in the page.
#pragma once

#include <string>
#include <string_view>

namespace umbrameter {

/// The bytes as a zlib stream (RFC 1950), the same on every machine.
std::string deflate(std::string_view bytes);

}  // namespace umbrameter
