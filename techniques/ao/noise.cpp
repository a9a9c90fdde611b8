#include "techniques/ao/noise.h"

#include "techniques/ao/random.h"

namespace umbrameter {

Parameters describe(AoNoiseParams& params) {
  return Description("ao")
      .field("noise-size", params.size,
             {.unit = "px", .meaning = "side of the tile of random rotations", .min = 1, .max = 64})
      .take();
}

std::vector<vec4> rotation_tile(const AoNoiseParams& params, std::uint32_t seed) {
  std::vector<vec4> rotations;
  for (int i = 0; i < params.size * params.size; ++i) {
    rotations.emplace_back(2.0f * ao_random(seed, AoRandom::rotation, i, 0) - 1.0f,
                           2.0f * ao_random(seed, AoRandom::rotation, i, 1) - 1.0f, 0.0f, 0.0f);
  }
  return rotations;
}

}  // namespace umbrameter
