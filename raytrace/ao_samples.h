// The directions of sixteen pixels, in an order that keeps equal ranks' rays together. For raytrace/*.cpp alone.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/math.h"
#include "raytrace/packet.h"
#include "raytrace/parameters.h"
#include "raytrace/sampler.h"
#include "raytrace/stopping.h"

namespace umbrameter {

/// Where a pixel looks.
struct PixelDirections {
  SampleRange range;
  mat3 frame{1.0f};          ///< of the hemisphere
  vec3 normal{0, 0, 1};      ///< of the triangle
  std::uint32_t stream = 0;  ///< a stream is a set of points that is independent of every other stream's
};

/// One ray of each pixel.
struct alignas(64) SampleRank {
  Directions directions;
  std::array<float, Packet::width> cosine{};  ///< with the triangle's normal
  std::array<std::uint8_t, Packet::width> randomisation{};
};

/// Ranges of equal size of sixteen pixels' points, each ordered by the part of the disk that they fall in, so that
/// equal ranks of neighbouring pixels look in about the same direction. Which points there are does not depend on the
/// order.
class PacketSamples {
 public:
  void make(const TruthParams& params, int lane, const PixelDirections& pixel);
  const SampleRank& operator[](std::size_t rank) const { return ranks_[rank]; }

 private:
  struct Unsorted {
    std::vector<float> u, v;  // the square, then the disk
    std::vector<float> x, y, z, cosine;
    std::vector<std::int32_t> stratum;
    std::vector<std::uint8_t> randomisation;
    void resize(std::size_t size);
  };

  Unsorted unsorted_;
  std::vector<SampleRank> ranks_;
};

}  // namespace umbrameter
