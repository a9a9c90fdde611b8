#include "reports/page/plane_words.h"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/packing.hpp>

namespace umbrameter {
namespace {

// From here on a half float is infinite or no number.
constexpr int not_finite = 0x7c00;

// Negative values have the highest bit and fall as the others grow.
std::uint16_t ordered(unsigned bits_of_value, int bits) {
  const unsigned sign = 1u << (bits - 1);
  const unsigned all = 2u * sign - 1u;
  return static_cast<std::uint16_t>((bits_of_value & sign) != 0 ? ~bits_of_value & all : bits_of_value | sign);
}

// Outside of the image stands the nearest pixel before it, and before the first 0.
int predicted(const Words& words, std::size_t i, std::size_t columns, Predictor predictor) {
  const bool has_left = i % columns != 0;
  const bool has_above = i >= columns;
  const int before = has_left ? words[i - 1] : has_above ? words[i - columns] : 0;
  const int above = has_above ? words[i - columns] : before;
  const int corner = has_left && has_above ? words[i - columns - 1] : above;
  const int gradient = before + above - corner;
  if (predictor == Predictor::gradient) return gradient;
  const int to_before = std::abs(above - corner);
  const int to_above = std::abs(before - corner);
  const int to_corner = std::abs(gradient - corner);
  if (to_before <= to_above && to_before <= to_corner) return before;
  return to_above <= to_corner ? above : corner;
}

}  // namespace

Words ordered(const Words& halves, int bits) {
  Words words;
  words.reserve(halves.size());
  for (const std::uint16_t half : halves) words.push_back(ordered(unsigned{half} >> (16 - bits), bits));
  return words;
}

Words ordered_differences(const Words& from, const Words& take) {
  Words words(from.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    const float difference = glm::unpackHalf1x16(from[i]) - glm::unpackHalf1x16(take[i]);
    if (!std::isfinite(difference)) continue;
    // The script does the same sum. Exponents differ by 112; what half floats have no normal numbers for is 0.
    const auto bits = std::bit_cast<std::uint32_t>(difference);
    const int rounded = static_cast<int>(((bits & 0x7fffffffu) + 0x1000u) >> 13u) - (112 << 10);
    const auto half = static_cast<unsigned>(std::min(std::max(rounded, 0), not_finite));
    words[i] = ordered(half | (bits >> 31u) << 15u, 16);
  }
  return words;
}

std::string residual_bytes(const std::vector<Words>& channels, int columns, int bits, Predictor predictor,
                           const Words& given) {
  const std::size_t count = channels.front().size();
  const std::size_t step = predictor == Predictor::none ? 2 * channels.size() : channels.size();
  const std::size_t high = predictor == Predictor::none ? 1 : channels.size() * count;
  std::string bytes(2 * channels.size() * count, '\0');
  const int half_range = 1 << (bits - 1);
  for (std::size_t i = 0; i < count; ++i) {
    int before = 0;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const int guess = predictor == Predictor::none ? 0
                        : predictor == Predictor::difference
                            ? given[i]
                            : predicted(channels[c], i, static_cast<std::size_t>(columns), predictor);
      const int missed = channels[c][i] - guess;
      const int rest = ((missed - before + half_range) & (2 * half_range - 1)) - half_range;
      before = missed;
      const int stored = rest < 0 ? -2 * rest - 1 : 2 * rest;
      const std::size_t at = step * i + (predictor == Predictor::none ? 2 * c : c);
      bytes[at] = static_cast<char>(stored & 0xff);
      bytes[at + high] = static_cast<char>(stored >> 8);
    }
  }
  return bytes;
}

}  // namespace umbrameter
