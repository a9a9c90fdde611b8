#include "reports/files/png.h"

#include <libdeflate.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <new>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

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

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8u | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

// PNG specification (third edition), section 5.3: length, name, data, CRC of name and data.
void add_chunk(std::string& png, std::string_view name, std::string_view data) {
  png += four_bytes(static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = png.size();
  png += name;
  png += data;
  png += four_bytes(libdeflate_crc32(0, png.data() + begin, png.size() - begin));
}

struct Indexed {
  std::string palette;  // RGB triples
  std::string indices;
};

// Nothing if the image has more colours than a byte can number.
std::optional<Indexed> indexed(const Image<glm::u8vec3>& image) {
  Indexed result;
  result.indices.reserve(image.size());
  std::unordered_map<std::uint32_t, char> numbers;
  for (const glm::u8vec3& color : image.pixels) {
    const std::uint32_t key = std::uint32_t{color.x} << 16u | std::uint32_t{color.y} << 8u | color.z;
    const auto [place, is_new] = numbers.try_emplace(key, static_cast<char>(numbers.size()));
    if (is_new && numbers.size() > 256) return std::nullopt;
    if (is_new)
      result.palette.append({static_cast<char>(color.x), static_cast<char>(color.y), static_cast<char>(color.z)});
    result.indices += place->second;
  }
  return result;
}

// Each row after the number of its filter: 2, the difference to the row above, if the rows are equal, as in enlarged
// images; else 0, none. Maps of errors, causes and accessibility repeat few colours, which the filters hide from the
// search for repetitions: such files are smaller without, and written several times as fast.
std::string filtered_rows(std::string_view bytes, std::size_t length) {
  const std::string zeros(length, '\0');
  std::string rows;
  rows.reserve(bytes.size() + bytes.size() / length);
  std::string_view above;
  for (; !bytes.empty(); bytes.remove_prefix(length)) {
    const std::string_view row = bytes.substr(0, length);
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
  const auto columns = static_cast<std::size_t>(width);
  if (std::optional<Indexed> few = indexed(image)) {
    palette = std::move(few->palette);
    rows = deflate(filtered_rows(few->indices, columns));
  } else {
    rows = deflate(filtered_rows({reinterpret_cast<const char*>(image.pixels.data()), 3 * image.size()}, 3 * columns));
  }
}

std::string to_png(const DeflatedImage& image) {
  constexpr std::size_t longest_chunk = std::numeric_limits<std::int32_t>::max();
  std::string png = "\x89PNG\r\n\x1a\n";
  // 8 bits a channel, colour type RGB or indexed, then the only methods there are, not interlaced.
  add_chunk(png, "IHDR",
            four_bytes(static_cast<std::uint32_t>(image.width)) + four_bytes(static_cast<std::uint32_t>(image.height)) +
                "\x08" + (image.palette.empty() ? "\x02" : "\x03") + std::string(3, '\0'));
  add_chunk(png, "sRGB", std::string_view("\0", 1));  // rendering intent: perceptual
  if (!image.palette.empty()) add_chunk(png, "PLTE", image.palette);
  for (std::string_view rest = image.rows; !rest.empty(); rest.remove_prefix(std::min(rest.size(), longest_chunk))) {
    add_chunk(png, "IDAT", rest.substr(0, longest_chunk));
  }
  add_chunk(png, "IEND", "");
  return png;
}

std::string to_png(const Image<glm::u8vec3>& image) { return to_png(DeflatedImage(image)); }

PngHeader png_header(std::string_view bytes) {
  // PNG specification, 5.6 and 11.2.2: the signature, and IHDR as the first chunk.
  constexpr std::size_t header_end = 33;
  if (bytes.size() < header_end || !bytes.starts_with("\x89PNG\r\n\x1a\n") || bytes.substr(12, 4) != "IHDR") {
    throw Error(ExitCode::partial, "PNG", "its header is damaged or missing");
  }
  constexpr std::uint32_t longest_side = std::numeric_limits<std::int32_t>::max();
  const std::uint32_t width = number_at(bytes, 16);
  const std::uint32_t height = number_at(bytes, 20);
  if (width < 1 || height < 1 || width > longest_side || height > longest_side) {
    throw Error(ExitCode::partial, "PNG", "its size is out of range");
  }
  // Deflate needs at least two bits for the longest match, 258 bytes (RFC 1951, 3.2.5).
  constexpr double most_inflated = 8.0 * 258.0 / 2.0;
  const auto bit_depth = static_cast<unsigned char>(bytes[24]);
  const auto color_type = static_cast<unsigned char>(bytes[25]);
  const int channels = color_type == 2 ? 3 : color_type == 4 ? 2 : color_type == 6 ? 4 : 1;
  const double pixel_bytes = bit_depth * channels / 8.0 * width * height;
  if (pixel_bytes > most_inflated * static_cast<double>(bytes.size())) {
    throw Error(ExitCode::partial, "PNG",
                "its " + std::to_string(bytes.size()) + " bytes are too few for its size of " + std::to_string(width) +
                    "x" + std::to_string(height) + " pixels");
  }
  PngHeader header{static_cast<int>(width), static_cast<int>(height)};
  for (std::size_t at = header_end; at + 12 <= bytes.size();) {
    const std::string_view name = bytes.substr(at + 4, 4);
    if (name == "IDAT") break;
    if (name == "sRGB") header.names_srgb = true;
    if (name == "gAMA" && bytes.size() >= at + 12) header.gamma = number_at(bytes, at + 8) / 100000.0;
    at += std::size_t{12} + number_at(bytes, at);
  }
  if (header.names_srgb) header.gamma = 0.0;
  return header;
}

namespace {

// What libpng works on. It leaves a function by longjmp when it fails, which calls no destructors: all that must be
// released is here.
struct PngReader {
  std::string_view rest;
  png_structp png = nullptr;
  png_infop info = nullptr;
  Image<glm::u16vec4> image{};
  std::vector<png_bytep> rows{};
  std::array<char, 200> problem{};

  explicit PngReader(std::string_view bytes) : rest(bytes) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, [](png_structp, png_const_charp) {});
    if (png != nullptr) info = png_create_info_struct(png);
    if (info == nullptr) throw std::bad_alloc();
  }
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
    auto& reader = *static_cast<PngReader*>(png_get_error_ptr(png));
    std::snprintf(reader.problem.data(), reader.problem.size(), "%s", message);
    png_longjmp(png, 1);
  }
  static void on_read(png_structp png, png_bytep to, std::size_t count) {
    auto& reader = *static_cast<PngReader*>(png_get_io_ptr(png));
    if (count > reader.rest.size()) png_error(png, "the file is truncated");
    std::memcpy(to, reader.rest.data(), count);
    reader.rest.remove_prefix(count);
  }
};

// Whether it succeeded. Has no locals that need a destructor.
bool read_pixels(PngReader& reader) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;  // NOLINT(cert-err52-cpp): libpng's way to fail
  png_set_read_fn(reader.png, &reader, PngReader::on_read);
  png_read_info(reader.png, reader.info);
  png_set_expand_16(reader.png);
  png_set_gray_to_rgb(reader.png);
  png_set_add_alpha(reader.png, 0xffff, PNG_FILLER_AFTER);
  if (std::endian::native == std::endian::little) png_set_swap(reader.png);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  reader.image = Image<glm::u16vec4>(static_cast<int>(png_get_image_width(reader.png, reader.info)),
                                     static_cast<int>(png_get_image_height(reader.png, reader.info)));
  if (png_get_rowbytes(reader.png, reader.info) !=
      sizeof(glm::u16vec4) * static_cast<std::size_t>(reader.image.width)) {
    png_error(reader.png, "its pixels have an unknown format");
  }
  for (int y = 0; y < reader.image.height; ++y) {
    reader.rows.push_back(reinterpret_cast<png_bytep>(&reader.image.at(0, y)));
  }
  png_read_image(reader.png, reader.rows.data());
  png_read_end(reader.png, nullptr);
  return true;
}

}  // namespace

Image<glm::u16vec4> from_png(std::string_view bytes) {
  png_header(bytes);
  PngReader reader(bytes);
  if (!read_pixels(reader)) throw Error(ExitCode::partial, "PNG", reader.problem.data());
  return std::move(reader.image);
}

}  // namespace umbrameter
