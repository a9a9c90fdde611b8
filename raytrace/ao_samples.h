// The directions of a pixel, in an order that keeps those that look alike together. For raytrace/*.cpp and tests.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math.h"
#include "raytrace/parameters.h"
#include "raytrace/sampler.h"
#include "raytrace/stopping.h"

namespace umbrameter {

/// Where a pixel looks from.
struct PixelDirections {
  SampleRange range;
  mat3 frame{1.0f};          ///< of the hemisphere
  vec3 normal{0, 0, 1};      ///< of the triangle
  double offset = 0;         ///< metres along the normal at which the rays start
  double reach = 0;          ///< metres from the surface up to which a hit counts
  std::uint32_t stream = 0;  ///< a stream is a set of points that is independent of every other stream's
};

/// Rays of one pixel, ordered by the part of the hemisphere's disk that they go through, so that successive ones meet
/// about the same things. Which rays there are does not depend on the order.
class PixelSamples {
 public:
  /// Arrays are this much longer than their content, with zeros: packets may read on.
  static constexpr std::size_t padding = 16;

  void make(const TruthParams& params, const PixelDirections& pixel);

  std::size_t size() const { return size_; }
  // A thousand points fit in the processor's nearest cache, but not twice: on their way to directions they wait where
  // other columns will be.
  std::vector<float> x, y, z;  ///< directions
  std::vector<float> cosine;   ///< with the triangle's normal
  std::vector<float> step;     ///< metres by which the ray starts beyond the surface point, along itself
  std::vector<float> reach;    ///< metres; negative below the triangle's plane
  std::vector<std::uint8_t> randomisation;

 private:
  void resize(std::size_t size);
  void order(const SampleRange& range, const Randomisations& before);

  std::size_t size_ = 0;
  std::vector<std::uint8_t> stratum_;
};

}  // namespace umbrameter
