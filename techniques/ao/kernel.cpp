#include "techniques/ao/kernel.h"

#include <cmath>

#include "techniques/ao/random.h"

namespace umbrameter {

std::vector<vec4> hemisphere_kernel(int samples, std::uint32_t seed) {
  std::vector<vec4> kernel;
  for (int i = 0; i < samples; ++i) {
    // Uniform on the hemisphere: z is uniform (Archimedes).
    const float z = ao_random(seed, AoRandom::kernel, i, 0);
    const float azimuth = static_cast<float>(2.0 * pi) * ao_random(seed, AoRandom::kernel, i, 1);
    const float across = std::sqrt(1.0f - z * z);
    const float share = static_cast<float>(i) / static_cast<float>(samples);
    const float length = ao_random(seed, AoRandom::kernel, i, 2) * (0.1f + 0.9f * share * share);
    kernel.emplace_back(length * across * std::cos(azimuth), length * across * std::sin(azimuth), length * z, 0.0f);
  }
  return kernel;
}

}  // namespace umbrameter
