// KHR_meshopt_compression, appendix A, "Mode 0: attributes".
#include "scenes/gltf_vertex_codec.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace umbrameter::gltf {
namespace {

constexpr unsigned char header_of_version_1 = 0xa1;
constexpr std::size_t group_size = 16;
constexpr std::size_t min_tail = 24;

/// Reads forward; past the end everything is zero.
struct Reader {
  std::span<const unsigned char> rest;
  bool is_past_end = false;

  unsigned byte() {
    if (rest.empty()) {
      is_past_end = true;
      return 0;
    }
    const unsigned value = rest.front();
    rest = rest.subspan(1);
    return value;
  }
};

// Sixteen deltas of `bits` bits each, then a byte for each that has all bits set. Bits of 1 are packed from the lowest
// bit of a byte on, those of 2 and 4 from the highest.
void read_packed(Reader& reader, unsigned bits, std::span<unsigned char> deltas) {
  const unsigned sentinel = (1u << bits) - 1u;
  const unsigned in_byte = 8u / bits;
  unsigned packed = 0;
  for (unsigned i = 0; i < deltas.size(); ++i) {
    if (i % in_byte == 0) packed = reader.byte();
    const unsigned place = i % in_byte * bits;
    deltas[i] = static_cast<unsigned char>((packed >> (bits == 1 ? place : 8u - bits - place)) & sentinel);
  }
  for (unsigned char& delta : deltas) {
    if (delta == sentinel) delta = static_cast<unsigned char>(reader.byte());
  }
}

/// The deltas of one byte position of a block, as many as there are elements, rounded up to whole groups.
void read_deltas(Reader& reader, unsigned control, std::size_t elements, std::span<unsigned char> deltas) {
  std::ranges::fill(deltas, static_cast<unsigned char>(0));
  if (control == 2) return;
  if (control == 3) {
    for (std::size_t i = 0; i < elements; ++i) deltas[i] = static_cast<unsigned char>(reader.byte());
    return;
  }
  constexpr unsigned bits_of_mode[2][4] = {{0, 1, 2, 4}, {1, 2, 4, 8}};
  const std::size_t groups = (elements + group_size - 1) / group_size;
  unsigned char modes[4] = {};  // two bits for each of the 16 groups that a block has at most
  for (std::size_t i = 0; i < (groups + 3) / 4; ++i) modes[i] = static_cast<unsigned char>(reader.byte());
  for (std::size_t group = 0; group < groups; ++group) {
    const unsigned mode = (unsigned{modes[group / 4]} >> (group % 4 * 2)) & 3u;
    const unsigned bits = bits_of_mode[control][mode];
    const auto part = deltas.subspan(group * group_size, group_size);
    if (bits == 8) {
      for (unsigned char& delta : part) delta = static_cast<unsigned char>(reader.byte());
    } else if (bits != 0) {
      read_packed(reader, bits, part);
    }
  }
}

template <class Unsigned>
Unsigned from_zigzag(Unsigned value) {
  return static_cast<Unsigned>((value & 1u) != 0 ? ~(value >> 1u) : value >> 1u);
}

// `mode` is that of a channel, which is four bytes; `delta` holds one of each byte, `value` those of the last element.
void add_delta(unsigned mode, const unsigned char* delta, unsigned char* value) {
  if ((mode & 15u) == 0) {
    for (int i = 0; i < 4; ++i) value[i] = static_cast<unsigned char>(value[i] + from_zigzag<std::uint8_t>(delta[i]));
  } else if ((mode & 15u) == 1) {
    for (int i = 0; i < 4; i += 2) {
      const unsigned last = value[i] | (unsigned{value[i + 1]} << 8u);
      const auto coded = static_cast<std::uint16_t>(delta[i] | (unsigned{delta[i + 1]} << 8u));
      const unsigned next = last + from_zigzag<std::uint16_t>(coded);
      value[i] = static_cast<unsigned char>(next & 0xffu);
      value[i + 1] = static_cast<unsigned char>((next >> 8u) & 0xffu);
    }
  } else {
    const unsigned turn = mode >> 4u;
    const std::uint32_t coded = delta[0] | (std::uint32_t{delta[1]} << 8u) | (std::uint32_t{delta[2]} << 16u) |
                                (std::uint32_t{delta[3]} << 24u);
    const std::uint32_t change = (coded >> turn) | (coded << ((32u - turn) & 31u));
    for (unsigned i = 0; i < 4; ++i) value[i] = static_cast<unsigned char>(value[i] ^ ((change >> (8u * i)) & 0xffu));
  }
}

bool is_mode(unsigned mode) { return (mode & 15u) < 2u ? mode < 16u : (mode & 15u) == 2u; }

}  // namespace

bool is_vertex_stream_1(std::span<const unsigned char> encoded) {
  return !encoded.empty() && encoded.front() == header_of_version_1;
}

bool decode_vertex_stream_1(std::span<const unsigned char> encoded, std::size_t stride,
                            std::span<unsigned char> elements) {
  const std::size_t channels = stride / 4;
  const std::size_t tail = std::max(stride + channels, min_tail);
  if (!is_vertex_stream_1(encoded) || encoded.size() < 1 + tail) return false;
  const auto modes = encoded.last(channels);
  if (!std::ranges::all_of(modes, is_mode)) return false;
  const auto baseline = encoded.last(stride + channels).first(stride);
  std::vector<unsigned char> value(baseline.begin(), baseline.end());
  Reader reader{encoded.subspan(1, encoded.size() - 1 - tail)};
  const std::size_t count = elements.size() / stride;
  const std::size_t block_size = std::min<std::size_t>(8192 / stride / group_size * group_size, 256);
  std::vector<unsigned char> control(channels);
  std::vector<unsigned char> deltas(block_size * stride);
  for (std::size_t first = 0; first < count && !reader.is_past_end; first += block_size) {
    const std::size_t size = std::min(block_size, count - first);
    for (unsigned char& byte : control) byte = static_cast<unsigned char>(reader.byte());
    for (std::size_t byte = 0; byte < stride; ++byte) {
      const unsigned mode = (unsigned{control[byte / 4]} >> (byte % 4 * 2)) & 3u;
      read_deltas(reader, mode, size, std::span(deltas).subspan(byte * block_size, block_size));
    }
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t channel = 0; channel < channels; ++channel) {
        unsigned char delta[4];
        for (std::size_t k = 0; k < 4; ++k) delta[k] = deltas[(4 * channel + k) * block_size + i];
        add_delta(modes[channel], delta, &value[4 * channel]);
      }
      std::memcpy(&elements[(first + i) * stride], value.data(), stride);
    }
  }
  return !reader.is_past_end && reader.rest.empty();
}

}  // namespace umbrameter::gltf
