#include "raytrace/ao_samples.h"

#include <algorithm>
#include <array>

#include "core/random.h"
#include "raytrace/vectors.h"

namespace umbrameter {
namespace {

// Parts of the disk's square in each direction by which a pixel's points are put in order.
constexpr int strata = 16;
static_assert(strata * strata <= 1 << 8, "a stratum is a byte");

int part_of(float coordinate) {
  const int part = static_cast<int>((coordinate + 1.0f) * (0.5f * strata));
  return part < 0 ? 0 : (part < strata ? part : strata - 1);
}

// Strata row by row, back and forth, so that neighbours follow one another.
int stratum_of(float x, float y) {
  const int row = part_of(y);
  const int column = part_of(x);
  return row * strata + ((row & 1) == 0 ? column : strata - 1 - column);
}

float wrapped(float value) { return value < 1.0f ? value : value - 1.0f; }

// The loops below are plain ones over arrays, so that the compiler makes vectors of them.

UMBRAMETER_VECTORS void to_disk(std::size_t size, vec2 shift, vec2 turn, float* u, float* v, std::uint8_t* stratum) {
  for (std::size_t i = 0; i < size; ++i) {
    const vec2 d = concentric_disk({wrapped(u[i] + shift.x), wrapped(v[i] + shift.y)});
    const float x = d.x * turn.x - d.y * turn.y;
    const float y = d.x * turn.y + d.y * turn.x;
    u[i] = x;
    v[i] = y;
    stratum[i] = static_cast<std::uint8_t>(stratum_of(x, y));
  }
}

struct Lifted {
  float* x = nullptr;
  float* y = nullptr;
  float* z = nullptr;
  float* cosine = nullptr;
};

// The compiler gives up on telling this many arrays apart by itself.
template <class Lift>
inline void lift_by(std::size_t size, const mat3 frame, const float* __restrict u, const float* __restrict v,
                    const Lifted& to, Lift lift) {
  float* __restrict const x = to.x;
  float* __restrict const y = to.y;
  float* __restrict const z = to.z;
  float* __restrict const cosine = to.cosine;
  for (std::size_t i = 0; i < size; ++i) {
    const vec3 local = lift(vec2(u[i], v[i]));
    x[i] = frame[0].x * local.x + frame[1].x * local.y + frame[2].x * local.z;
    y[i] = frame[0].y * local.x + frame[1].y * local.y + frame[2].y * local.z;
    z[i] = frame[0].z * local.x + frame[1].z * local.y + frame[2].z * local.z;
    cosine[i] = local.z;
  }
}

UMBRAMETER_VECTORS void to_world_cosine(std::size_t size, const mat3& frame, const float* u, const float* v,
                                        const Lifted& to) {
  lift_by(size, frame, u, v, to, [](vec2 disk) { return lift_cosine(disk); });
}

UMBRAMETER_VECTORS void to_world_uniform(std::size_t size, const mat3& frame, const float* u, const float* v,
                                         const Lifted& to) {
  lift_by(size, frame, u, v, to, [](vec2 disk) { return lift_uniform(disk); });
}

UMBRAMETER_VECTORS void to_cosines(std::size_t size, const vec3& normal, const Lifted& of) {
  for (std::size_t i = 0; i < size; ++i) {
    of.cosine[i] = normal.x * of.x[i] + normal.y * of.y[i] + normal.z * of.z[i];
  }
}

// A hit counts up to `reach` from the surface point: the ray starts above it, which shortens its way by
// offset · cosine to first order.
UMBRAMETER_VECTORS void to_reaches(std::size_t size, float offset, double reach, const float* cosine, float* steps,
                                   float* reaches) {
  for (std::size_t i = 0; i < size; ++i) {
    const float step = offset * cosine[i];
    const double left = reach - static_cast<double>(step);
    const float above = static_cast<float>(left > 0.0 ? left : 0.0);
    steps[i] = step;
    reaches[i] = cosine[i] > 0.0f ? above : -1.0f;
  }
}

}  // namespace

// A counting sort that keeps the points of a stratum as they were.
void PixelSamples::order(const SampleRange& range, const Randomisations& before) {
  std::array<std::uint32_t, strata * strata + 1> next{};
  // The compiler cannot tell that bytes are written to one of these arrays only.
  const std::uint8_t* __restrict const stratum = stratum_.data();
  const float* __restrict const from_u = x.data();
  const float* __restrict const from_v = y.data();
  float* __restrict const to_u = step.data();
  float* __restrict const to_v = reach.data();
  std::uint8_t* __restrict const to_randomisation = randomisation.data();
  for (std::size_t i = 0; i < size_; ++i) ++next[static_cast<std::size_t>(stratum[i]) + 1u];
  for (std::size_t s = 1; s < next.size(); ++s) next[s] += next[s - 1];
  std::size_t i = 0;
  for (int r = 0; r < range.split.count; ++r) {
    for (const std::size_t end = i + static_cast<std::size_t>(range.split.size(r) - before.size(r)); i < end; ++i) {
      const std::uint32_t place = next[static_cast<std::size_t>(stratum[i])]++;
      to_u[place] = from_u[i];
      to_v[place] = from_v[i];
      to_randomisation[place] = static_cast<std::uint8_t>(r);
    }
  }
}

void PixelSamples::resize(std::size_t size) {
  size_ = size;
  for (std::vector<float>* values : {&x, &y, &z, &cosine, &step, &reach}) {
    values->resize(size + padding);
    std::fill(values->end() - static_cast<std::ptrdiff_t>(padding), values->end(), 0.0f);
  }
  stratum_.resize(size);
  randomisation.resize(size);
}

void PixelSamples::make(const TruthParams& params, const PixelDirections& pixel) {
  const SampleRange& range = pixel.range;
  resize(static_cast<std::size_t>(range.size()));
  const Randomisations before{range.split.count, range.begin};
  std::size_t first = 0;
  for (int r = 0; r < range.split.count; ++r) {
    const std::uint32_t scramble = hash(pixel.stream, static_cast<std::uint32_t>(r));
    const auto begin = static_cast<std::uint32_t>(before.size(r));
    const auto count = static_cast<std::size_t>(range.split.size(r)) - begin;
    float* const u = x.data() + first;
    float* const v = y.data() + first;
    make_points(params.sampler == Sampler::owen, begin, scramble, {u, count}, {v, count});
    // Shifted and turned at random: edges of occluders that run along the square's or through the middle of the disk
    // would else have the same count in every randomisation, or one of two, and such counts are far from a normal
    // distribution (Cranley and Patterson 1976 for the shift).
    const vec2 shift(to_unit_float(hash(scramble, 2u)), to_unit_float(hash(scramble, 3u)));
    to_disk(count, shift, direction_at(to_unit_float(hash(scramble, 4u))), u, v, stratum_.data() + first);
    first += count;
  }
  order(range, before);
  const Lifted lifted{x.data(), y.data(), z.data(), cosine.data()};
  if (params.ao_weight == AoWeight::cosine) {
    to_world_cosine(size_, pixel.frame, step.data(), reach.data(), lifted);
  } else {
    to_world_uniform(size_, pixel.frame, step.data(), reach.data(), lifted);
  }
  if (pixel.frame[2] != pixel.normal) to_cosines(size_, pixel.normal, lifted);
  to_reaches(size_, static_cast<float>(pixel.offset), pixel.reach, cosine.data(), step.data(), reach.data());
}

}  // namespace umbrameter
