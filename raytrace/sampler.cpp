#include "raytrace/sampler.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace umbrameter {
namespace {

// Fewer points than this each would waste the sequence's evenness.
constexpr int least_points = 2;
constexpr int usual_randomisations = 8;
constexpr int ample_points = 128;

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

vec2 random_point(std::uint32_t index, std::uint32_t scramble) {
  return {to_unit_float(hash(scramble, index, 0u)), to_unit_float(hash(scramble, index, 1u))};
}

vec2 concentric_disk(vec2 point) {
  // Just within the square, so that no direction is level.
  constexpr float inside = 1.0f - 0x1p-22f;
  const vec2 p = inside * (2.0f * point - 1.0f);
  if (p.x == 0.0f && p.y == 0.0f) return p;
  const bool is_wide = std::abs(p.x) > std::abs(p.y);
  const float radius = is_wide ? p.x : p.y;
  const float angle = static_cast<float>(pi / 4.0) * (is_wide ? p.y / p.x : p.x / p.y);
  const float along = radius * std::cos(angle);
  const float across = radius * std::sin(angle);
  return is_wide ? vec2(along, across) : vec2(across, along);
}

vec3 lift_cosine(vec2 disk) { return {disk.x, disk.y, std::sqrt(std::max(1.0f - glm::dot(disk, disk), 0x1p-24f))}; }

vec3 lift_uniform(vec2 disk) {
  const float squared = glm::dot(disk, disk);
  return vec3(disk * std::sqrt(2.0f - squared), std::max(1.0f - squared, 0x1p-24f));
}

mat3 frame_about(vec3 n) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  return {vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x), vec3(b, sign + n.y * n.y * a, -n.y), n};
}

Randomisations split(int spp) {
  const int wanted = std::clamp(spp / ample_points, usual_randomisations, most_randomisations);
  return {std::clamp(spp / least_points, 1, wanted), spp};
}

}  // namespace umbrameter
