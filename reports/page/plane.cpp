#include "reports/page/plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/lists.h"
#include "reports/files/deflate.h"
#include "reports/files/markup.h"
#include "reports/page/plane_words.h"

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
  return {{"type", type}, {"data", to_base64(deflate(bytes, DeflateLevel::small))}};
}

std::size_t length_of(const Json& plane) { return plane["data"].get_ref<const std::string&>().size(); }

int columns_of(int width, int stride) { return (width + stride - 1) / stride; }

// All low bytes, then all high ones: similar bytes stand together, which deflates better.
std::string split_bytes(const std::vector<std::uint16_t>& words) {
  std::string bytes(2 * words.size(), '\0');
  for (std::size_t i = 0; i < words.size(); ++i) {
    bytes[i] = static_cast<char>(words[i] & 0xffu);
    bytes[words.size() + i] = static_cast<char>(words[i] >> 8u);
  }
  return bytes;
}

std::vector<std::uint16_t> halves_of(const Image<float>& image, int stride) {
  return mapped(sampled(image, stride), [](const float value) { return glm::packHalf1x16(value); });
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

constexpr int dropped_bits = 4;

// Rounds the fraction to 6 of its 10 bits. A carry goes into the exponent, as it should.
std::uint16_t with_few_bits(std::uint16_t half) {
  if ((half & 0x7c00u) == 0x7c00u) return half;  // infinite or no number
  const unsigned rounded = half + (1u << (dropped_bits - 1));
  // The largest numbers are rounded down, because rounded up they were infinite.
  const unsigned kept = (rounded & 0x7c00u) == 0x7c00u ? half : rounded;
  return static_cast<std::uint16_t>(kept & ~((1u << dropped_bits) - 1u));
}

bool is_share(float value) { return value >= 0.0f && value <= 1.0f; }

bool is_byte(float value) { return value >= 0.0f && value <= 255.0f && value == std::floor(value); }

// The least of what the predictors give.
Json predicted(const std::vector<Words>& channels, int columns, int bits) {
  Json best;
  for (const Predictor predictor : {Predictor::none, Predictor::paeth, Predictor::gradient}) {
    Json json = packed("f16", residual_bytes(channels, columns, bits, predictor));
    if (!best.is_null() && length_of(json) >= length_of(best)) continue;
    json["predictor"] = predictor_names[static_cast<std::size_t>(predictor)];
    best = std::move(json);
  }
  best["channels"] = channels.size();
  best["columns"] = columns;
  best["bits"] = bits;
  return best;
}

Words ordered_halves(const Image<float>& image, int stride, PlaneDigits digits, int bits) {
  std::vector<std::uint16_t> halves = halves_of(image, stride);
  if (digits != PlaneDigits::half) {
    for (std::uint16_t& half : halves) half = with_few_bits(half);
  }
  return ordered(halves, bits);
}

int bits_of(PlaneDigits digits) { return digits == PlaneDigits::half ? 16 : 16 - dropped_bits; }

// Bytes where there are at most 256 different values, or where bytes are exact enough.
std::optional<Json> as_bytes(const Image<float>& image, int stride, PlaneDigits digits) {
  const std::vector<float> values = sampled(image, stride);
  const auto bytes_of = [&](float factor) {
    std::string bytes;
    for (const float value : values) {
      bytes += static_cast<char>(static_cast<std::uint8_t>(std::lround(factor * value)));
    }
    return bytes;
  };
  if (std::ranges::all_of(values, is_byte)) return packed("u8", bytes_of(1.0f));
  if (std::optional<Json> json = with_palette(halves_of(image, stride))) return json;
  if (digits != PlaneDigits::byte || !std::ranges::all_of(values, is_share)) return std::nullopt;
  return packed("share", bytes_of(255.0f));
}

}  // namespace

Json plane_json(const Image<std::uint8_t>& image, int stride) {
  const std::vector<std::uint8_t> values = sampled(image, stride);
  return packed("u8", {values.begin(), values.end()});
}

Json plane_json(const Image<std::uint16_t>& image, int stride) {
  const Words values = sampled(image, stride);
  if (std::ranges::all_of(values, [](unsigned value) { return value <= 255; })) {
    return packed("u8", {values.begin(), values.end()});
  }
  return packed("u16", split_bytes(values));
}

Json plane_json(const Image<std::uint16_t>& image, const Image<std::uint8_t>& category, int stride) {
  const Words values = sampled(image, stride);
  const std::vector<std::uint8_t> categories = sampled(category, stride);
  std::array<Words, 256> lists;
  for (std::size_t i = 0; i < values.size(); ++i) lists[categories[i]].push_back(values[i]);
  Words grouped;
  for (std::size_t c = 1; c < lists.size(); ++c) grouped.insert(grouped.end(), lists[c].begin(), lists[c].end());
  return packed("u16", split_bytes(grouped));
}

Json plane_json(const Image<float>& image, int stride, PlaneDigits digits) {
  if (std::optional<Json> json = as_bytes(image, stride, digits)) return *std::move(json);
  const int bits = bits_of(digits);
  return predicted({ordered_halves(image, stride, digits, bits)}, columns_of(image.width, stride), bits);
}

std::vector<Json> planes_json(const std::vector<Image<float>>& planes, int stride, PlaneDigits digits) {
  std::vector<Json> items;
  std::vector<Words> channels;
  const int bits = bits_of(digits);
  for (const Image<float>& plane : planes) {
    if (std::optional<Json> json = as_bytes(plane, stride, digits)) {
      items.push_back(*std::move(json));
    } else {
      channels.push_back(ordered_halves(plane, stride, digits, bits));
    }
  }
  if (items.empty()) return {predicted(channels, columns_of(planes[0].width, stride), bits)};
  items.clear();
  for (const Image<float>& plane : planes) items.push_back(plane_json(plane, stride, digits));
  return items;
}

Json difference_json(const Image<float>& error, const Image<float>& technique, const Image<float>& reference,
                     int stride) {
  Json json = plane_json(error, stride);
  if (json["type"] != "f16") return json;
  const Words given = ordered_differences(halves_of(technique, stride), halves_of(reference, stride));
  const Words words = ordered_halves(error, stride, PlaneDigits::half, 16);
  Json other = packed("f16", residual_bytes({words}, json["columns"], 16, Predictor::difference, given));
  if (length_of(other) >= length_of(json)) return json;
  json["data"] = std::move(other["data"]);
  json["predictor"] = predictor_names[static_cast<std::size_t>(Predictor::difference)];
  return json;
}

}  // namespace umbrameter
