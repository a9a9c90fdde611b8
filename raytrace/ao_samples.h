// The directions of one pixel, in an order that keeps neighbouring pixels' rays together. For raytrace/*.cpp alone.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math.h"
#include "raytrace/parameters.h"
#include "raytrace/sampler.h"

namespace umbrameter {

struct Sample {
  vec2 disk{0};  ///< of the unit disk, for lift_cosine or lift_uniform
  std::uint16_t randomisation = 0;
  std::uint16_t stratum = 0;
};

/// Which of a pixel's points are wanted: of `split.points` in all, those beyond the first `begin`.
struct SampleRange {
  Randomisations split;
  int begin = 0;
  int size() const { return split.points - begin; }
};

/// A range of a pixel's points, ordered by the part of the disk that they fall in, so that equal ranks of neighbouring
/// pixels look in about the same direction. Which points there are does not depend on the order.
class PixelSamples {
 public:
  /// A stream is a set of points that is independent of every other stream's.
  void make(Sampler sampler, const SampleRange& range, std::uint32_t stream);
  const Sample& operator[](std::size_t rank) const { return sorted_[rank]; }

 private:
  std::vector<Sample> unsorted_;
  std::vector<Sample> sorted_;
};

}  // namespace umbrameter
