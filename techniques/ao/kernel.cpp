#include "techniques/ao/kernel.h"

#include <array>
#include <cmath>
#include <string_view>

#include "techniques/ao/random.h"

namespace umbrameter {
namespace {

// Numbers from 0 to 1: z of the direction, its azimuth in turns, the distance before its factor, and the share i/n that
// the factor depends on. Uniform on the hemisphere: z is uniform (Archimedes).
vec4 make_point(float z, float turns, float distance, float share) {
  const float azimuth = static_cast<float>(2.0 * pi) * turns;
  const float across = std::sqrt(1.0f - z * z);
  const float length = distance * (0.1f + 0.9f * share * share);
  return {length * across * std::cos(azimuth), length * across * std::sin(azimuth), length * z, 0.0f};
}

// Number i of the additive sequence of four dimensions (M. Roberts, The Unreasonable Effectiveness of Quasirandom
// Sequences, 2018): the steps are powers of 1/g, g⁵ = g + 1.
float sequence(std::uint32_t seed, int i, std::uint32_t dimension) {
  constexpr double g = 1.1673039782614187;
  const double start = static_cast<double>(ao_random(seed, AoRandom::kernel, 0, dimension));
  const double value = start + (i + 1) * std::pow(1.0 / g, static_cast<double>(dimension) + 1.0);
  return static_cast<float>(value - std::floor(value));
}

}  // namespace

Parameters describe(AoKernelParams& params) {
  static constexpr std::array<std::string_view, 2> names{"learnopengl", "progressive"};
  return Description("ao")
      .choice("kernel", params.kind, names,
              {.unit = {},
               .meaning = "points of hemisphere SSAO: random as in Learn OpenGL, or a progressive sequence: "
                          "more samples keep the earlier points"})
      .take();
}

std::vector<vec4> hemisphere_kernel(const AoKernelParams& params, int samples, std::uint32_t seed) {
  std::vector<vec4> kernel;
  for (int i = 0; i < samples; ++i) {
    if (params.kind == AoKernel::progressive) {
      kernel.push_back(
          make_point(sequence(seed, i, 0), sequence(seed, i, 1), sequence(seed, i, 2), sequence(seed, i, 3)));
      continue;
    }
    const auto number = [&](std::uint32_t dimension) { return ao_random(seed, AoRandom::kernel, i, dimension); };
    kernel.push_back(make_point(number(0), number(1), number(2), static_cast<float>(i) / static_cast<float>(samples)));
  }
  return kernel;
}

}  // namespace umbrameter
