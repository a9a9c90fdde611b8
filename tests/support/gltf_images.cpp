// The two image writers of gltf_builder.h.
#include <cassert>
#include <cstdlib>

#include "tests/support/gltf_builder.h"

namespace umbrameter::test {
namespace {

void append_big_endian(Bytes& bytes, std::uint32_t value, unsigned size) {
  for (unsigned i = size; i-- > 0;) bytes.push_back(static_cast<unsigned char>((value >> (8 * i)) & 0xffu));
}

// PNG specification, annex D.
std::uint32_t crc(const Bytes& bytes) {
  std::uint32_t value = 0xffffffffu;
  for (const unsigned char byte : bytes) {
    value ^= byte;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1u) ^ ((value & 1u) != 0 ? 0xedb88320u : 0u);
  }
  return ~value;
}

void append_chunk(Bytes& file, std::string_view type, const Bytes& data) {
  append_big_endian(file, static_cast<std::uint32_t>(data.size()), 4);
  Bytes body(type.begin(), type.end());
  body.insert(body.end(), data.begin(), data.end());
  file.insert(file.end(), body.begin(), body.end());
  append_big_endian(file, crc(body), 4);
}

// RFC 1950 and section 3.2.4 of RFC 1951: one stored block.
Bytes stored_zlib(const Bytes& data) {
  assert(data.size() < 0x10000);
  const auto size = static_cast<unsigned>(data.size());
  Bytes bytes = {0x78, 0x01, 0x01};
  for (const unsigned part : {size, ~size}) {
    bytes.push_back(static_cast<unsigned char>(part & 0xffu));
    bytes.push_back(static_cast<unsigned char>((part >> 8u) & 0xffu));
  }
  bytes.insert(bytes.end(), data.begin(), data.end());
  std::uint32_t low = 1;
  std::uint32_t high = 0;
  for (const unsigned char byte : data) {
    low = (low + byte) % 65521u;
    high = (high + low) % 65521u;
  }
  append_big_endian(bytes, (high << 16u) | low, 4);
  return bytes;
}

void append_segment(Bytes& file, unsigned char marker, const Bytes& data) {
  file.push_back(0xff);
  file.push_back(marker);
  append_big_endian(file, static_cast<std::uint32_t>(data.size()) + 2, 2);
  file.insert(file.end(), data.begin(), data.end());
}

/// Bits of a scan, with a zero byte after each 0xff (T.81, section B.1.1.5).
struct BitWriter {
  Bytes bytes;
  std::uint32_t held = 0;
  unsigned count = 0;

  void put(std::uint32_t value, unsigned size) {
    for (unsigned i = size; i-- > 0;) {
      held = (held << 1u) | ((value >> i) & 1u);
      if (++count < 8) continue;
      bytes.push_back(static_cast<unsigned char>(held & 0xffu));
      if (bytes.back() == 0xff) bytes.push_back(0);
      held = 0;
      count = 0;
    }
  }
};

}  // namespace

Bytes png(int width, int height, const Bytes& rgba) {
  Bytes file = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  Bytes header;
  append_big_endian(header, static_cast<std::uint32_t>(width), 4);
  append_big_endian(header, static_cast<std::uint32_t>(height), 4);
  header.insert(header.end(), {8, 6, 0, 0, 0});
  append_chunk(file, "IHDR", header);
  Bytes rows;
  const std::ptrdiff_t row = 4 * static_cast<std::ptrdiff_t>(width);
  for (int y = 0; y < height; ++y) {
    rows.push_back(0);
    rows.insert(rows.end(), rgba.begin() + y * row, rgba.begin() + (y + 1) * row);
  }
  append_chunk(file, "IDAT", stored_zlib(rows));
  append_chunk(file, "IEND", {});
  return file;
}

// Only the mean of a block is coded: with a quantiser step of 8 it is the coefficient itself, less 128.
Bytes grey_jpeg(int blocks_across, int blocks_down, const Bytes& values) {
  Bytes file = {0xff, 0xd8};
  Bytes quantiser(65, 8);
  quantiser[0] = 0;
  append_segment(file, 0xdb, quantiser);
  Bytes frame = {8};
  append_big_endian(frame, static_cast<std::uint32_t>(8 * blocks_down), 2);
  append_big_endian(frame, static_cast<std::uint32_t>(8 * blocks_across), 2);
  frame.insert(frame.end(), {1, 1, 0x11, 0});
  append_segment(file, 0xc0, frame);
  // Twelve codes of four bits for the size of a difference; one code of one bit for the end of a block.
  Bytes sizes = {0x00, 0, 0, 0, 12, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  append_segment(file, 0xc4, sizes);
  append_segment(file, 0xc4, {0x10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  append_segment(file, 0xda, {1, 1, 0, 0, 63, 0});
  BitWriter bits;
  int last = 0;
  for (const unsigned char value : values) {
    const int coefficient = static_cast<int>(value) - 128;
    const int difference = coefficient - last;
    last = coefficient;
    unsigned size = 0;
    while ((std::abs(difference) >> size) != 0) ++size;
    bits.put(size, 4);
    bits.put(static_cast<std::uint32_t>(difference < 0 ? difference + (1 << size) - 1 : difference), size);
    bits.put(0, 1);
  }
  bits.put(0x7f, 7);
  file.insert(file.end(), bits.bytes.begin(), bits.bytes.end());
  file.insert(file.end(), {0xff, 0xd9});
  return file;
}

Bytes huffman_table(unsigned char codes) {
  Bytes table(17 + 16 * std::size_t{codes}, codes);
  table[0] = 0;
  Bytes segment;
  append_segment(segment, 0xc4, table);
  return segment;
}

}  // namespace umbrameter::test
