#include "raytrace/ao_samples.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace umbrameter {
namespace {

// Parts of the disk's square in each direction by which a pixel's points are put in order.
constexpr int strata = 16;

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

// The loops below are plain ones over arrays, so that the compiler makes vectors of them.

float wrapped(float value) { return value < 1.0f ? value : value - 1.0f; }

void to_disk(std::size_t size, vec2 shift, vec2 turn, float* u, float* v) {
  for (std::size_t i = 0; i < size; ++i) {
    const vec2 d = concentric_disk({wrapped(u[i] + shift.x), wrapped(v[i] + shift.y)});
    u[i] = d.x * turn.x - d.y * turn.y;
    v[i] = d.x * turn.y + d.y * turn.x;
  }
}

void to_strata(std::size_t size, const float* u, const float* v, std::int32_t* stratum) {
  for (std::size_t i = 0; i < size; ++i) stratum[i] = stratum_of(u[i], v[i]);
}

template <class Lift>
void to_world(std::size_t size, const PixelDirections& pixel, const float* u, const float* v, float* x, float* y,
              float* z, float* cosine, Lift lift) {
  const mat3 frame = pixel.frame;
  const vec3 normal = pixel.normal;
  for (std::size_t i = 0; i < size; ++i) {
    const vec3 local = lift(vec2(u[i], v[i]));
    x[i] = frame[0].x * local.x + frame[1].x * local.y + frame[2].x * local.z;
    y[i] = frame[0].y * local.x + frame[1].y * local.y + frame[2].y * local.z;
    z[i] = frame[0].z * local.x + frame[1].z * local.y + frame[2].z * local.z;
    cosine[i] = local.z;
  }
  if (frame[2] == normal) return;
  for (std::size_t i = 0; i < size; ++i) cosine[i] = normal.x * x[i] + normal.y * y[i] + normal.z * z[i];
}

}  // namespace

void PacketSamples::Unsorted::resize(std::size_t size) {
  for (std::vector<float>* values : {&u, &v, &x, &y, &z, &cosine}) values->resize(size);
  stratum.resize(size);
  randomisation.resize(size);
}

void PacketSamples::make(const TruthParams& params, int lane, const PixelDirections& pixel) {
  const SampleRange& range = pixel.range;
  const auto size = static_cast<std::size_t>(range.size());
  unsorted_.resize(size);
  if (ranks_.size() < size) ranks_.resize(size);
  Unsorted& all = unsorted_;
  const Randomisations before{range.split.count, range.begin};
  std::size_t first = 0;
  for (int r = 0; r < range.split.count; ++r) {
    const std::uint32_t scramble = hash(pixel.stream, static_cast<std::uint32_t>(r));
    const auto begin = static_cast<std::uint32_t>(before.size(r));
    const auto count = static_cast<std::size_t>(range.split.size(r)) - begin;
    make_points(params.sampler == Sampler::owen, begin, scramble, {all.u.data() + first, count},
                {all.v.data() + first, count});
    // Shifted and turned at random: edges of occluders that run along the square's or through the middle of the disk
    // would else have the same count in every randomisation, or one of two, and such counts are far from a normal
    // distribution (Cranley and Patterson 1976 for the shift).
    const vec2 shift(to_unit_float(hash(scramble, 2u)), to_unit_float(hash(scramble, 3u)));
    const float angle = static_cast<float>(2.0 * pi) * to_unit_float(hash(scramble, 4u));
    to_disk(count, shift, {std::cos(angle), std::sin(angle)}, all.u.data() + first, all.v.data() + first);
    std::fill_n(all.randomisation.begin() + static_cast<std::ptrdiff_t>(first), count, static_cast<std::uint8_t>(r));
    first += count;
  }
  const auto place = [&](auto lift) {
    to_world(size, pixel, all.u.data(), all.v.data(), all.x.data(), all.y.data(), all.z.data(), all.cosine.data(),
             lift);
  };
  if (params.ao_weight == AoWeight::cosine) {
    place([](vec2 disk) { return lift_cosine(disk); });
  } else {
    place([](vec2 disk) { return lift_uniform(disk); });
  }

  to_strata(size, all.u.data(), all.v.data(), all.stratum.data());
  std::array<std::uint32_t, strata * strata + 1> next{};
  for (const std::int32_t stratum : all.stratum) ++next[static_cast<std::size_t>(stratum) + 1u];
  for (std::size_t s = 1; s < next.size(); ++s) next[s] += next[s - 1];
  const auto l = static_cast<std::size_t>(lane);
  for (std::size_t i = 0; i < size; ++i) {
    SampleRank& rank = ranks_[next[static_cast<std::size_t>(all.stratum[i])]++];
    rank.directions.x[l] = all.x[i];
    rank.directions.y[l] = all.y[i];
    rank.directions.z[l] = all.z[i];
    rank.cosine[l] = all.cosine[i];
    rank.randomisation[l] = all.randomisation[i];
  }
}

}  // namespace umbrameter
