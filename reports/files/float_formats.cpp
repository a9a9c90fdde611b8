#include "reports/files/float_formats.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/lists.h"

namespace umbrameter {
namespace {

constexpr int max_size = 1 << 20;  // pixels of a side: beyond it a header is damaged, not large

class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : rest_(bytes) {}

  std::string_view take(std::size_t count) {
    if (count > rest_.size()) throw std::runtime_error("the file is truncated");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  unsigned next() { return static_cast<unsigned char>(take(1).front()); }

  std::string_view line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) throw std::runtime_error("the header is truncated");
    std::string_view text = take(end + 1).substr(0, end);
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }

  /// A word and the one white-space character after it.
  std::string_view word() {
    const std::size_t end = rest_.find_first_of(" \t\r\n");
    if (end == std::string_view::npos) throw std::runtime_error("the header is truncated");
    return take(end + 1).substr(0, end);
  }
  std::size_t left() const { return rest_.size(); }

 private:
  std::string_view rest_;
};

template <class T>
T number(std::string_view text) {
  if (const std::optional<T> value = parsed<T>(text)) return *value;
  throw std::runtime_error("'" + std::string(text.substr(0, 20)) + "' in the header is not a number");
}

int side(std::string_view text) {
  const int value = number<int>(text);
  if (value < 1 || value > max_size) throw std::runtime_error("the size in the header is out of range");
  return value;
}

using Rgbe = std::array<std::uint8_t, 4>;

// Ward, Real Pixels, Graphics Gems II, 1991: mantissas of 8 bits with one exponent.
vec3 color_of(const Rgbe& rgbe) {
  if (rgbe[3] == 0) return vec3(0.0f);
  const float scale = std::ldexp(1.0f, static_cast<int>(rgbe[3]) - (128 + 8));
  return vec3(rgbe[0], rgbe[1], rgbe[2]) * scale;
}

// Run-length encoded: for each component, runs of up to 127 equal bytes or up to 128 different ones.
void read_encoded_row(Bytes& bytes, std::vector<Rgbe>& row) {
  for (std::size_t component = 0; component < 4; ++component) {
    for (std::size_t x = 0; x < row.size();) {
      const unsigned code = bytes.next();
      const std::size_t count = code > 128 ? code - 128 : code;
      if (count == 0 || count > row.size() - x) throw std::runtime_error("a run leaves its row");
      const unsigned repeated = code > 128 ? bytes.next() : 0;
      for (std::size_t i = 0; i < count; ++i) {
        row[x++][component] = static_cast<std::uint8_t>(code > 128 ? repeated : bytes.next());
      }
    }
  }
}

Rgbe next_rgbe(Bytes& bytes) {
  Rgbe rgbe{};
  std::memcpy(rgbe.data(), bytes.take(4).data(), 4);
  return rgbe;
}

void read_row(Bytes& bytes, std::vector<Rgbe>& row) {
  const Rgbe first = next_rgbe(bytes);
  const std::size_t width = row.size();
  if (width >= 8 && width < 32768 && first[0] == 2 && first[1] == 2 && first[2] * 256u + first[3] == width) {
    return read_encoded_row(bytes, row);
  }
  row[0] = first;
  for (std::size_t x = 1; x < width; ++x) {
    row[x] = next_rgbe(bytes);
    if (row[x][0] == 1 && row[x][1] == 1 && row[x][2] == 1) {
      throw std::runtime_error("the old run-length encoding is not supported; save it again");
    }
  }
}

}  // namespace

namespace {

struct RadianceHeader {
  ivec2 size;
  float exposure = 1.0f;
};

// Leaves the pixels.
RadianceHeader read_radiance_header(Bytes& bytes) {
  if (!bytes.line().starts_with("#?")) throw std::runtime_error("it is no Radiance HDR file");
  float exposure = 1.0f;
  for (std::string_view line = bytes.line(); !line.empty(); line = bytes.line()) {
    if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe") {
      throw std::runtime_error("only the format 32-bit_rle_rgbe is supported");
    }
    if (line.starts_with("EXPOSURE=")) {
      std::string_view value = line.substr(9);
      value.remove_prefix(std::min(value.find_first_not_of(' '), value.size()));
      exposure *= number<float>(value);
    }
  }
  if (!(exposure > 0.0f)) throw std::runtime_error("EXPOSURE in the header is not above 0");
  Bytes size(bytes.line());
  const auto direction = [&](std::string_view expected) {
    if (size.word() != expected) throw std::runtime_error("only the orientation '-Y height +X width' is supported");
  };
  direction("-Y");
  const int height = side(size.word());
  direction("+X");
  const int width = side(size.take(size.left()));
  // A run of at most 127 pixels takes two bytes in each of four components.
  if (static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) / 127 > bytes.left() / 8) {
    throw std::runtime_error("the file is truncated");
  }
  return {{width, height}, exposure};
}

struct PfmHeader {
  ivec2 size;
  std::size_t channels = 3;
  bool is_little_endian = false;
  std::size_t row_bytes() const { return 4 * channels * static_cast<std::size_t>(size.x); }
};

// Leaves the pixels.
PfmHeader read_pfm_header(Bytes& bytes) {
  const std::string_view magic = bytes.word();
  if (magic != "PF" && magic != "Pf") throw std::runtime_error("it is no PFM file");
  PfmHeader header;
  header.channels = magic == "PF" ? 3 : 1;
  header.size.x = side(bytes.word());
  header.size.y = side(bytes.word());
  header.is_little_endian = number<float>(bytes.word()) < 0.0f;  // the sign of the scale is the byte order
  if (bytes.left() / header.row_bytes() < static_cast<std::size_t>(header.size.y)) {
    throw std::runtime_error("the file is truncated");
  }
  return header;
}

}  // namespace

ivec2 size_of_radiance(std::string_view text) {
  Bytes bytes(text);
  return read_radiance_header(bytes).size;
}

ivec2 size_of_pfm(std::string_view text) {
  Bytes bytes(text);
  return read_pfm_header(bytes).size;
}

Image<vec3> from_radiance(std::string_view text) {
  Bytes bytes(text);
  const auto& [size, exposure] = read_radiance_header(bytes);
  const auto [width, height] = std::pair(size.x, size.y);
  Image<vec3> image(width, height);
  std::vector<Rgbe> row(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    read_row(bytes, row);
    for (int x = 0; x < width; ++x) image.at(x, y) = color_of(row[static_cast<std::size_t>(x)]) / exposure;
  }
  return image;
}

Image<vec3> from_pfm(std::string_view text) {
  Bytes bytes(text);
  const PfmHeader header = read_pfm_header(bytes);
  const auto [width, height] = std::pair(header.size.x, header.size.y);
  Image<vec3> image(width, height);
  for (int y = height - 1; y >= 0; --y) {  // the bottom row is first
    const std::string_view row = bytes.take(header.row_bytes());
    for (int x = 0; x < width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = 4 * (static_cast<std::size_t>(x) * header.channels + (header.channels == 3 ? c : 0));
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < 4; ++i) {
          const auto byte = static_cast<unsigned char>(row[at + (header.is_little_endian ? 3 - i : i)]);
          bits = bits << 8 | byte;
        }
        image.at(x, y)[static_cast<int>(c)] = std::bit_cast<float>(bits);
      }
    }
  }
  return image;
}

}  // namespace umbrameter
