#include "techniques/ao/noise.h"

#include <algorithm>
#include <numeric>

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

std::vector<vec4> stratified_tile(const AoNoiseParams& params, std::uint32_t seed) {
  const int count = params.size * params.size;
  std::vector<vec4> tile(static_cast<std::size_t>(count), vec4(0.0f));
  for (const int axis : {0, 1}) {
    const auto number = [&](int i, std::uint32_t dimension) {
      return ao_random(seed, AoRandom::stratum, i, 2 * static_cast<std::uint32_t>(axis) + dimension);
    };
    std::vector<int> order(tile.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](int i) { return number(i, 0); });
    for (int i = 0; i < count; ++i) {
      const int stratum = order[static_cast<std::size_t>(i)];
      tile[static_cast<std::size_t>(i)][axis] =
          (static_cast<float>(stratum) + number(i, 1)) / static_cast<float>(count);
    }
  }
  return tile;
}

}  // namespace umbrameter
