// PNG as bytes: written in 8-bit sRGB, with nothing in them that changes between runs; read as anyone writes them.
#pragma once

#include <string>
#include <string_view>

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

/// An image compressed once, for a PNG and for a PDF. Throws Error (partial) when it has no pixels.
struct DeflatedImage {
  int width = 0;
  int height = 0;
  std::string palette;  ///< RGB triples of at most 256 colours; empty if the image has more
  std::string rows;     ///< zlib stream (RFC 1950) of the rows: the number of a PNG filter, then indices or RGB triples

  DeflatedImage() = default;
  explicit DeflatedImage(const Image<glm::u8vec3>& image);
};

/// The bytes of a PNG file with an sRGB chunk.
std::string to_png(const DeflatedImage& image);
std::string to_png(const Image<glm::u8vec3>& image);

/// What a PNG file says about itself before its pixels.
struct PngHeader {
  int width = 0;
  int height = 0;
  /// Of the file's gAMA chunk, code value = light^gamma; 0 where an sRGB chunk comes with it, or where it has none.
  double gamma = 0.0;
  bool names_srgb = false;  ///< it has an sRGB chunk; with neither, readers assume sRGB at any bit depth
};

/// Throws Error (partial) when the bytes are no PNG, or too few for an image of its size.
PngHeader png_header(std::string_view bytes);

/// Red, green, blue and alpha as the file stores them, in 16 bits: codes of 8 bits times 257. Throws Error (partial)
/// when the bytes are no PNG.
Image<glm::u16vec4> from_png(std::string_view bytes);

}  // namespace umbrameter
