// Rays for ambient occlusion, in an order that keeps those that look alike together. For raytrace/*.cpp and tests.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math.h"
#include "raytrace/parameters.h"
#include "raytrace/ray_lanes.h"
#include "raytrace/sampler.h"
#include "raytrace/stopping.h"

namespace umbrameter {

/// Where pixels look from that show the same triangle.
struct Hemisphere {
  mat3 frame{1.0f};
  vec3 normal{0, 0, 1};    ///< of the triangle
  double offset = 0;       ///< metres along the normal at which the rays start
  double reach = 0;        ///< metres from the surface up to which a hit counts
  float clear_cosine = 0;  ///< with the normal, of a direction that cannot meet the triangle
  bool operator==(const Hemisphere&) const = default;
};

/// Rays that are wanted of a pixel.
struct PixelRays {
  vec3 origin{0};
  SampleRange range;
  std::uint32_t stream = 0;  ///< a stream is a set of points that is independent of every other stream's
};

/// What else is known of a packet's rays.
struct LiftedLanes {
  std::array<float, packet_width> step{};  ///< metres by which a ray starts beyond the surface point, along itself
  bool are_clear = false;                  ///< none can meet its own triangle
};

/// Rays of some pixels, ordered by the part of the hemisphere's disk that they go through, so that successive ones,
/// whichever pixel's, meet about the same things. Which rays a pixel has does not depend on the others.
class HemisphereSamples {
 public:
  static constexpr std::size_t most_pixels = 64;
  static constexpr std::size_t sources = most_pixels * most_randomisations;

  void make(const TruthParams& params, const Hemisphere& hemisphere, std::span<const PixelRays> pixels);

  std::size_t size() const { return points_.size() - packet_width; }
  /// Index of the ray's pixel times most_randomisations, plus its randomisation.
  std::size_t source(std::size_t ray) const { return source_[ray]; }
  static std::size_t source_of(std::size_t pixel, std::size_t randomisation) {
    return pixel * most_randomisations + randomisation;
  }

  static std::size_t pixel_of(std::size_t source) { return source / most_randomisations; }

  /// A packet's rays from `first` on. Lanes beyond the last ray look up from the first pixel.
  void lift(std::size_t first, const RayLanes& to, LiftedLanes& lifted) const;

 private:
  using Source = std::uint16_t;
  static_assert(sources <= 1u << 16u);

  void order(std::size_t strata);

  Hemisphere hemisphere_;
  AoWeight weight_ = AoWeight::cosine;
  std::array<vec3, most_pixels> origins_{};
  // As they are made, and in order; the latter are a packet longer.
  std::vector<vec2> made_points_, points_;  // on the disk
  std::vector<Source> made_source_, source_;
  std::vector<std::uint16_t> made_stratum_;
  std::vector<std::uint32_t> next_;  // place of a stratum's next point
  std::vector<float> u_, v_;         // on the square, of one randomisation
};

}  // namespace umbrameter
