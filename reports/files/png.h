// PNG as bytes: 8-bit sRGB, nothing in them that changes between runs.
#pragma once

#include <string>

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

/// The bytes of a PNG file with an sRGB chunk. Throws Error (partial) when the image has no pixels.
std::string to_png(const Image<glm::u8vec3>& image);

/// The pixels of a PNG file, laid over white. Throws Error (partial) when the bytes are no PNG.
Image<glm::u8vec3> from_png(const std::string& bytes);
/// With alpha, which does not multiply the colours.
Image<glm::u8vec4> from_png_with_alpha(const std::string& bytes);

}  // namespace umbrameter
