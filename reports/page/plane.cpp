#include "reports/page/plane.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/files/deflate.h"
#include "reports/files/markup.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
std::vector<T> sampled(const Image<T>& image, int stride) {
  std::vector<T> values;
  for (int y = 0; y < image.height; y += stride) {
    for (int x = 0; x < image.width; x += stride) values.push_back(image.at(x, y));
  }
  return values;
}

Json packed(const char* type, const std::string& bytes) {
  return {{"type", type}, {"data", to_base64(deflate(bytes))}};
}

// All low bytes, then all high ones: similar bytes stand together, which deflates better.
std::string split_bytes(const std::vector<std::uint16_t>& words) {
  std::string bytes(2 * words.size(), '\0');
  for (std::size_t i = 0; i < words.size(); ++i) {
    bytes[i] = static_cast<char>(words[i] & 0xffu);
    bytes[words.size() + i] = static_cast<char>(words[i] >> 8u);
  }
  return bytes;
}

// The bytes of at most 256 different half floats, otherwise nothing.
std::optional<Json> with_palette(const std::vector<std::uint16_t>& halves) {
  std::vector<int> place(65536, -1);
  std::vector<std::uint16_t> palette;
  std::string bytes;
  for (const std::uint16_t half : halves) {
    if (place[half] < 0) {
      if (palette.size() == 256) return std::nullopt;
      place[half] = static_cast<int>(palette.size());
      palette.push_back(half);
    }
    bytes += static_cast<char>(static_cast<std::uint8_t>(place[half]));
  }
  Json json = packed("pal", bytes);
  json["palette"] = palette;
  return json;
}

// Rounds the fraction to 6 of its 10 bits. A carry goes into the exponent, as it should.
std::uint16_t with_few_bits(std::uint16_t half) {
  constexpr unsigned dropped = 4;
  if ((half & 0x7c00u) == 0x7c00u) return half;  // infinite or no number
  const unsigned rounded = half + (1u << (dropped - 1));
  // The largest numbers are rounded down, because rounded up they were infinite.
  const unsigned kept = (rounded & 0x7c00u) == 0x7c00u ? half : rounded;
  return static_cast<std::uint16_t>(kept & ~((1u << dropped) - 1u));
}

bool is_share(float value) { return value >= 0.0f && value <= 1.0f; }

bool is_byte(float value) { return value >= 0.0f && value <= 255.0f && value == std::floor(value); }

}  // namespace

Json plane_json(const Image<std::uint8_t>& image, int stride) {
  const std::vector<std::uint8_t> values = sampled(image, stride);
  return packed("u8", {values.begin(), values.end()});
}

Json plane_json(const Image<std::uint16_t>& image, int stride) {
  return packed("u16", split_bytes(sampled(image, stride)));
}

Json plane_json(const Image<float>& image, int stride, PlaneDigits digits) {
  const std::vector<float> values = sampled(image, stride);
  if (std::all_of(values.begin(), values.end(), is_byte)) {
    std::string bytes;
    for (const float value : values) bytes += static_cast<char>(static_cast<std::uint8_t>(value));
    return packed("u8", bytes);
  }
  std::vector<std::uint16_t> halves;
  for (const float value : values) halves.push_back(glm::packHalf1x16(value));
  if (const std::optional<Json> json = with_palette(halves)) return *json;
  if (digits == PlaneDigits::byte && std::all_of(values.begin(), values.end(), is_share)) {
    std::string bytes;
    for (const float value : values) bytes += static_cast<char>(static_cast<std::uint8_t>(std::lround(255.0f * value)));
    return packed("share", bytes);
  }
  if (digits != PlaneDigits::half) {
    for (std::uint16_t& half : halves) half = with_few_bits(half);
  }
  return packed("f16", split_bytes(halves));
}

}  // namespace umbrameter
