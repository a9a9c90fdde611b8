#include "raytrace/ao_samples.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "core/random.h"
#include "raytrace/vectors.h"

namespace umbrameter {
namespace {

// Cells of the square around the disk by which points are sorted: row by row in alternating direction, so that
// consecutive cells are neighbours.
struct Strata {
  int rows = 1;
  int columns = 1;

  int of(float x, float y) const {
    const int row = static_cast<int>((y + 1.0f) * (0.5f * static_cast<float>(rows)));
    const float along = (row & 1) == 0 ? x : -x;
    return row * columns + static_cast<int>((along + 1.0f) * (0.5f * static_cast<float>(columns)));
  }
  // One more row and cell, because rounding may put a point on the far edge of a row or of the square.
  std::size_t count() const {
    const int cells = (rows + 1) * columns + 1;
    return static_cast<std::size_t>(cells);
  }
};

// About four points per cell, and as many rows as make a packet's sixteen points cover about a square
// (docs/decisions/packets-of-neighbours.md).
Strata strata_of(std::size_t points) {
  constexpr std::size_t max_points = 1u << 16u;
  const auto ordered = static_cast<int>(std::clamp<std::size_t>(points, 4, max_points));
  const auto rows = static_cast<int>(std::lround(std::sqrt(static_cast<double>(ordered)) / 3.0));
  return {rows, ordered / (4 * rows)};
}

// Floats per widest vector. Arrays are padded to it: a remainder handled one by one would take most of the time.
constexpr std::size_t widest_vector = 16;
std::size_t whole_vectors(std::size_t count) { return (count + widest_vector - 1) / widest_vector * widest_vector; }

float wrap_unit(float value) { return value < 1.0f ? value : value - 1.0f; }

// The loops below are written so that the compiler vectorises them.

UMBRAMETER_VECTORS void to_disk(std::size_t size, vec2 shift, vec2 turn, Strata strata, const float* __restrict u,
                                const float* __restrict v, vec2* __restrict points, std::uint16_t* __restrict stratum) {
  for (std::size_t i = 0; i < size; ++i) {
    const vec2 d = concentric_disk({wrap_unit(u[i] + shift.x), wrap_unit(v[i] + shift.y)});
    const float x = d.x * turn.x - d.y * turn.y;
    const float y = d.x * turn.y + d.y * turn.x;
    points[i] = {x, y};
    stratum[i] = static_cast<std::uint16_t>(strata.of(x, y));
  }
}

// A hit counts up to `reach` from the surface point. The ray starts at `offset` above it, so its own reach is shorter
// by offset · cosine, to first order.
template <class Lift>
UMBRAMETER_IN_VECTORS void lift_by(const vec2* points, const Hemisphere& hemisphere, const RayLanes& to,
                                   LiftedLanes& lifted, Lift lift) {
  const mat3 frame = hemisphere.frame;
  const vec3 normal = hemisphere.normal;
  const auto offset = static_cast<float>(hemisphere.offset);
  const double reach = hemisphere.reach;
  // Local arrays, which the compiler knows not to overlap.
  float x[packet_width], y[packet_width], z[packet_width], cosine[packet_width], step[packet_width],
      reaches[packet_width];
  for (std::size_t i = 0; i < packet_width; ++i) {
    const vec3 local = lift(points[i]);
    x[i] = frame[0].x * local.x + frame[1].x * local.y + frame[2].x * local.z;
    y[i] = frame[0].y * local.x + frame[1].y * local.y + frame[2].y * local.z;
    z[i] = frame[0].z * local.x + frame[1].z * local.y + frame[2].z * local.z;
    cosine[i] = local.z;
  }
  if (frame[2] != normal) {
    for (std::size_t i = 0; i < packet_width; ++i) cosine[i] = normal.x * x[i] + normal.y * y[i] + normal.z * z[i];
  }
  int may_meet_own = 0;
  for (std::size_t i = 0; i < packet_width; ++i) {
    step[i] = offset * cosine[i];
    const double left = reach - static_cast<double>(step[i]);
    const float above = static_cast<float>(left > 0.0 ? left : 0.0);
    reaches[i] = cosine[i] > 0.0f ? above : -1.0f;
    may_meet_own |= (cosine[i] > 0.0f ? 1 : 0) & (cosine[i] > hemisphere.clear_cosine ? 0 : 1);
  }
  std::memcpy(to.dx, x, sizeof x);
  std::memcpy(to.dy, y, sizeof y);
  std::memcpy(to.dz, z, sizeof z);
  std::memcpy(to.reach, reaches, sizeof reaches);
  std::memcpy(lifted.step.data(), step, sizeof step);
  lifted.are_clear = may_meet_own == 0;
}

UMBRAMETER_VECTORS void lift_lanes(const vec2* points, const Hemisphere& hemisphere, AoWeight weight,
                                   const RayLanes& to, LiftedLanes& lifted) {
  if (weight == AoWeight::cosine) {
    lift_by(points, hemisphere, to, lifted, [](vec2 disk) { return lift_cosine(disk); });
  } else {
    lift_by(points, hemisphere, to, lifted, [](vec2 disk) { return lift_uniform(disk); });
  }
}

}  // namespace

void HemisphereSamples::lift(std::size_t first, const RayLanes& to, LiftedLanes& lifted) const {
  lift_lanes(points_.data() + first, hemisphere_, weight_, to, lifted);
  for (std::size_t i = 0; i < packet_width; ++i) {
    const vec3& origin = origins_[pixel_of(source_[first + i])];
    to.x[i] = origin.x;
    to.y[i] = origin.y;
    to.z[i] = origin.z;
  }
}

// A stable counting sort.
void HemisphereSamples::order(std::size_t strata) {
  const std::size_t size = made_source_.size();
  points_.resize(size + packet_width);
  source_.resize(size + packet_width);
  std::fill_n(points_.data() + size, packet_width, vec2(0));
  std::fill_n(source_.data() + size, packet_width, Source{0});
  next_.assign(strata + 1, 0);
  // Tells the compiler that the arrays do not overlap.
  std::uint32_t* __restrict const next = next_.data();
  const std::uint16_t* __restrict const stratum = made_stratum_.data();
  const vec2* __restrict const from = made_points_.data();
  vec2* __restrict const to = points_.data();
  const Source* __restrict const from_source = made_source_.data();
  Source* __restrict const to_source = source_.data();
  for (std::size_t i = 0; i < size; ++i) ++next[static_cast<std::size_t>(stratum[i]) + 1u];
  for (std::size_t s = 1; s <= strata; ++s) next[s] += next[s - 1];
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t place = next[stratum[i]]++;
    to[place] = from[i];
    to_source[place] = from_source[i];
  }
}

void HemisphereSamples::make(const TruthParams& params, const Hemisphere& hemisphere, std::span<const PixelRays> pixels,
                             RayOrder ray_order) {
  hemisphere_ = hemisphere;
  weight_ = params.ao_weight;
  std::size_t size = 0;
  for (const PixelRays& pixel : pixels) size += static_cast<std::size_t>(pixel.range.size());
  made_points_.resize(size + widest_vector);
  made_stratum_.resize(size + widest_vector);
  made_source_.resize(size);
  // Sorting is stable: by the strata of one pixel alone, each pixel's rays come in the order that they have alone.
  const bool is_as_alone = ray_order == RayOrder::as_alone;
  const Strata strata = strata_of(is_as_alone ? static_cast<std::size_t>(pixels.front().range.size()) : size);
  std::size_t first = 0;
  for (std::size_t p = 0; p < pixels.size(); ++p) {
    const PixelRays& pixel = pixels[p];
    assert(!is_as_alone || pixel.range.size() == pixels.front().range.size());
    const Randomisations& all = pixel.range.split;
    const Randomisations before{all.count, pixel.range.begin};
    origins_[p] = pixel.origin;
    for (int r = 0; r < all.count; ++r) {
      const std::uint32_t scramble = hash(pixel.stream, static_cast<std::uint32_t>(r));
      const auto begin = static_cast<std::uint32_t>(before.size(r));
      const auto count = static_cast<std::size_t>(all.size(r)) - begin;
      u_.resize(whole_vectors(count));
      v_.resize(whole_vectors(count));
      make_points(params.sampler == Sampler::owen, begin, scramble, u_, v_);
      // Each randomisation is shifted (Cranley and Patterson 1976) and rotated at random. Otherwise, for an edge of an
      // occluder parallel to the square's sides or through the disk's centre, all randomisations would give the same
      // one or two counts, which are far from normally distributed.
      const vec2 shift(to_unit_float(hash(scramble, 2u)), to_unit_float(hash(scramble, 3u)));
      // Writes up to a vector too much, which the next randomisation overwrites.
      to_disk(u_.size(), shift, direction_at(to_unit_float(hash(scramble, 4u))), strata, u_.data(), v_.data(),
              made_points_.data() + first, made_stratum_.data() + first);
      const std::size_t source = source_of(p, static_cast<std::size_t>(r));
      std::fill_n(made_source_.data() + first, count, static_cast<Source>(source));
      first += count;
    }
  }
  order(strata.count());
}

}  // namespace umbrameter
