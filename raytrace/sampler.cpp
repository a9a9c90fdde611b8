#include "raytrace/sampler.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace umbrameter {
namespace {

constexpr int most_randomisations = 8;
// Fewer points than this each would waste the sequence's evenness.
constexpr int least_points = 2;

std::uint32_t reverse_bits(std::uint32_t x) {
  x = ((x >> 1u) & 0x55555555u) | ((x & 0x55555555u) << 1u);
  x = ((x >> 2u) & 0x33333333u) | ((x & 0x33333333u) << 2u);
  x = ((x >> 4u) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4u);
  x = ((x >> 8u) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8u);
  return (x >> 16u) | (x << 16u);
}

// Burley 2020, listing 3: a permutation in which each bit is changed by lower bits only.
std::uint32_t laine_karras(std::uint32_t x, std::uint32_t seed) {
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return x;
}

// The second dimension's generator matrix is Pascal's triangle modulo 2 (Sobol 1967): direction numbers
// v(k+1) = v(k) xor v(k)/2. Returned with its bits reversed, least digit first, as the scramble wants it.
std::uint32_t reversed_second_dimension(std::uint32_t index) {
  std::uint32_t result = 0;
  for (std::uint32_t direction = 0x80000000u; index != 0; index >>= 1u, direction ^= direction >> 1u) {
    if ((index & 1u) != 0) result ^= direction;
  }
  return reverse_bits(result);
}

float unit_from(std::uint32_t reversed, std::uint32_t seed) {
  return to_unit_float(reverse_bits(laine_karras(reversed, seed)));
}

}  // namespace

vec2 owen_sobol(std::uint32_t index, std::uint32_t scramble) {
  // The first dimension is the radical inverse in base 2: reversed, the index itself.
  return {unit_from(index, hash(scramble, 0u)), unit_from(reversed_second_dimension(index), hash(scramble, 1u))};
}

vec3 cosine_hemisphere(vec2 point) {
  const float radius = std::sqrt(point.x);
  const float azimuth = static_cast<float>(2.0 * pi) * point.y;
  return {radius * std::cos(azimuth), radius * std::sin(azimuth), std::sqrt(1.0f - point.x)};
}

vec3 uniform_hemisphere(vec2 point) {
  const float z = 1.0f - point.x;
  const float radius = std::sqrt(std::max(0.0f, 1.0f - z * z));
  const float azimuth = static_cast<float>(2.0 * pi) * point.y;
  return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
}

mat3 frame_about(vec3 n) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  return {vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x), vec3(b, sign + n.y * n.y * a, -n.y), n};
}

Randomisations split(int spp) { return {std::clamp(spp / least_points, 1, most_randomisations), spp}; }

}  // namespace umbrameter
