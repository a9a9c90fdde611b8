// Random numbers of the AO techniques: functions of the seed, the purpose and an index.
#pragma once

#include <cstdint>

#include "core/random.h"

namespace umbrameter {

enum class AoRandom : std::uint32_t { kernel, rotation, stratum };

/// Uniform in [0, 1).
inline float ao_random(std::uint32_t seed, AoRandom purpose, int index, std::uint32_t dimension) {
  return to_unit_float(hash(seed, static_cast<std::uint32_t>(purpose), static_cast<std::uint32_t>(index), dimension));
}

}  // namespace umbrameter
