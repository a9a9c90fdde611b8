#include "raytrace/sampler.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "raytrace/vectors.h"

namespace umbrameter {
namespace {

// Points per randomisation.
constexpr int min_points = 2;
constexpr int default_randomisations = 8;
constexpr int ample_points = 64;  // allows more than the default number of randomisations

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

// The second dimension's generator matrix is Pascal's triangle modulo 2 (Sobol 1967), whose entry (d, k) is odd where
// the digits of d are among those of k (Lucas): digit d of the point is the sum of the index's digits k over such k,
// gathered one digit of d at a time. The result has its bits reversed, least digit first, as the scramble needs them.
std::uint32_t reversed_second_dimension(std::uint32_t index) {
  index ^= (index & 0xaaaaaaaau) >> 1u;
  index ^= (index & 0xccccccccu) >> 2u;
  index ^= (index & 0xf0f0f0f0u) >> 4u;
  index ^= (index & 0xff00ff00u) >> 8u;
  return index ^ (index >> 16u);
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

namespace {

UMBRAMETER_VECTORS void make_sobol_points(std::uint32_t begin, std::uint32_t scramble, std::uint32_t size, float* x,
                                          float* y) {
  const std::uint32_t first = hash(scramble, 0u);
  const std::uint32_t second = hash(scramble, 1u);
  for (std::uint32_t i = 0; i < size; ++i) x[i] = unit_from(begin + i, first);
  for (std::uint32_t i = 0; i < size; ++i) y[i] = unit_from(reversed_second_dimension(begin + i), second);
}

}  // namespace

void make_points(bool is_sobol, std::uint32_t begin, std::uint32_t scramble, std::span<float> x, std::span<float> y) {
  const auto size = static_cast<std::uint32_t>(x.size());
  if (is_sobol) {
    make_sobol_points(begin, scramble, size, x.data(), y.data());
    return;
  }
  for (std::uint32_t i = 0; i < size; ++i) {
    const vec2 point = random_point(begin + i, scramble);
    x[i] = point.x;
    y[i] = point.y;
  }
}

mat3 frame_about(vec3 n) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  return {vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x), vec3(b, sign + n.y * n.y * a, -n.y), n};
}

Randomisations split(int spp) {
  const int wanted = std::clamp(spp / ample_points, default_randomisations, max_randomisations);
  return {std::clamp(spp / min_points, 1, wanted), spp};
}

}  // namespace umbrameter
