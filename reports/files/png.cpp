#include "reports/files/png.h"

#include <libdeflate.h>
#include <png.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>

#include "core/error.h"
#include "reports/files/deflate.h"

namespace umbrameter {
namespace {

// Of a PNG, most significant byte first.
std::string four_bytes(std::uint32_t value) {
  std::string bytes;
  for (const unsigned shift : {24u, 16u, 8u, 0u}) bytes += static_cast<char>(value >> shift & 0xffu);
  return bytes;
}

// PNG specification (third edition), section 5.3: length, name, data, CRC of name and data.
void add_chunk(std::string& png, std::string_view name, std::string_view data) {
  png += four_bytes(static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = png.size();
  png += name;
  png += data;
  png += four_bytes(libdeflate_crc32(0, png.data() + begin, png.size() - begin));
}

// Each row after the number of its filter: 2, the difference to the row above, if the rows are equal, as in enlarged
// images; else 0, none. Maps of errors, causes and accessibility repeat few colours, which the filters hide from the
// search for repetitions: such files are smaller without, and written several times as fast.
std::string filtered_rows(const Image<glm::u8vec3>& image) {
  const std::size_t length = 3 * static_cast<std::size_t>(image.width);
  const std::string zeros(length, '\0');
  std::string rows;
  rows.reserve((length + 1) * static_cast<std::size_t>(image.height));
  std::string_view above;
  for (int y = 0; y < image.height; ++y) {
    const std::string_view row(reinterpret_cast<const char*>(&image.at(0, y)), length);
    const bool repeats = row == above;
    rows += repeats ? '\2' : '\0';
    rows += repeats ? zeros : row;
    above = row;
  }
  return rows;
}

}  // namespace

DeflatedImage::DeflatedImage(const Image<glm::u8vec3>& image) : width(image.width), height(image.height) {
  if (image.empty()) throw Error(ExitCode::partial, "PNG", "the image has no pixels");
  rows = deflate(filtered_rows(image));
}

std::string to_png(const DeflatedImage& image) {
  constexpr std::size_t longest_chunk = std::numeric_limits<std::int32_t>::max();
  std::string png = "\x89PNG\r\n\x1a\n";
  // 8 bits a channel, colour type RGB, then the only methods there are, not interlaced.
  add_chunk(png, "IHDR",
            four_bytes(static_cast<std::uint32_t>(image.width)) + four_bytes(static_cast<std::uint32_t>(image.height)) +
                std::string("\x08\x02\0\0\0", 5));
  add_chunk(png, "sRGB", std::string_view("\0", 1));  // rendering intent: perceptual
  for (std::string_view rest = image.rows; !rest.empty(); rest.remove_prefix(std::min(rest.size(), longest_chunk))) {
    add_chunk(png, "IDAT", rest.substr(0, longest_chunk));
  }
  add_chunk(png, "IEND", "");
  return png;
}

std::string to_png(const Image<glm::u8vec3>& image) { return to_png(DeflatedImage(image)); }

Image<glm::u8vec3> from_png(const std::string& bytes) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  const auto fail = [&] {
    const std::string problem = header.message;
    png_image_free(&header);
    throw Error(ExitCode::partial, "PNG", problem);
  };
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0) fail();
  header.format = PNG_FORMAT_RGB;
  Image<glm::u8vec3> image(static_cast<int>(header.width), static_cast<int>(header.height));
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&header, &white, image.pixels.data(), 0, nullptr) == 0) fail();
  return image;
}

}  // namespace umbrameter
