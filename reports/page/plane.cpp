#include "reports/page/plane.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "reports/files/markup.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

// The higher levels save a few per cent and take a multiple of the time.
constexpr int compression_level = 3;

template <class T>
std::vector<T> sampled(const Image<T>& image, int stride) {
  std::vector<T> values;
  for (int y = 0; y < image.height; y += stride) {
    for (int x = 0; x < image.width; x += stride) values.push_back(image.at(x, y));
  }
  return values;
}

Json packed(const char* type, const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string deflated(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(deflated.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), compression_level);
  if (status != Z_OK) throw Error(ExitCode::partial, "page", "cannot compress an image");
  deflated.resize(size);
  return {{"type", type}, {"data", to_base64(deflated)}};
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

bool is_byte(float value) { return value >= 0.0f && value <= 255.0f && value == std::floor(value); }

}  // namespace

Json plane_json(const Image<std::uint8_t>& image, int stride) {
  const std::vector<std::uint8_t> values = sampled(image, stride);
  return packed("u8", {values.begin(), values.end()});
}

Json plane_json(const Image<std::uint16_t>& image, int stride) {
  return packed("u16", split_bytes(sampled(image, stride)));
}

Json plane_json(const Image<float>& image, int stride) {
  const std::vector<float> values = sampled(image, stride);
  if (std::all_of(values.begin(), values.end(), is_byte)) {
    std::string bytes;
    for (const float value : values) bytes += static_cast<char>(static_cast<std::uint8_t>(value));
    return packed("u8", bytes);
  }
  std::vector<std::uint16_t> halves;
  for (const float value : values) halves.push_back(glm::packHalf1x16(value));
  return packed("f16", split_bytes(halves));
}

}  // namespace umbrameter
