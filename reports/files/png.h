// PNG as bytes: 8-bit sRGB, nothing in them that changes between runs.
#pragma once

#include <string>

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

/// An image compressed once, for a PNG and for a PDF. Throws Error (partial) when it has no pixels.
struct DeflatedImage {
  int width = 0;
  int height = 0;
  std::string rows;  ///< zlib stream (RFC 1950) of the rows: the number of a PNG filter, then RGB triples

  DeflatedImage() = default;
  explicit DeflatedImage(const Image<glm::u8vec3>& image);
};

/// The bytes of a PNG file with an sRGB chunk.
std::string to_png(const DeflatedImage& image);
std::string to_png(const Image<glm::u8vec3>& image);

/// The pixels of a PNG file, laid over white. Throws Error (partial) when the bytes are no PNG.
Image<glm::u8vec3> from_png(const std::string& bytes);

}  // namespace umbrameter
