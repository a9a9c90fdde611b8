// Random numbers as a function of what they are for (pixel, sample, seed), never of who drew before:
// that is what makes results independent of the number of threads.
#pragma once

#include <cstdint>

namespace umbrameter {

/// A well-mixed 32-bit value of a 32-bit one: PCG's output permutation (Jarzynski and Olano,
/// Hash Functions for GPU Rendering, JCGT 9(3), 2020).
constexpr std::uint32_t hash(std::uint32_t value) {
  const std::uint32_t state = value * 747796405u + 2891336453u;
  const std::uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

template <class... Rest>
constexpr std::uint32_t hash(std::uint32_t first, Rest... rest) {
  return hash(first + 0x9e3779b9u * hash(static_cast<std::uint32_t>(rest)...));
}

/// Maps the upper 24 bits to [0, 1).
constexpr float to_unit_float(std::uint32_t bits) {
  // Processors convert signed numbers faster.
  return static_cast<float>(static_cast<std::int32_t>(bits >> 8u)) * 0x1p-24f;
}

}  // namespace umbrameter
