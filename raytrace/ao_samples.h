// Rays for ambient occlusion, sorted so that rays of similar direction are consecutive. For raytrace/*.cpp and tests.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math.h"
#include "raytrace/adaptive_sampling.h"
#include "raytrace/ray_lanes.h"
#include "raytrace/sampler.h"
#include "techniques/truth/parameters.h"

namespace umbrameter {

/// The hemisphere of directions of a pixel. Pixels that show the same triangle mostly share it.
struct Hemisphere {
  mat3 frame{1.0f};        ///< its third column is the axis
  vec3 normal{0, 0, 1};    ///< of the triangle
  double offset = 0;       ///< metres along the normal at which the rays start
  double reach = 0;        ///< metres from the surface; hits beyond do not count
  float clear_cosine = 0;  ///< as RayOrigin::clear_cosine
  bool operator==(const Hemisphere&) const = default;
};

/// The rays to make for a pixel.
struct PixelRays {
  vec3 origin{0};
  SampleRange range;
  std::uint32_t stream = 0;  ///< seeds the points; different streams are independent
};

/// Properties of the rays that lift() has written.
struct LiftedLanes {
  std::array<float, packet_width> step{};  ///< metres from the surface point to the ray's origin, along the ray
  bool are_clear = false;                  ///< none can hit its own triangle
};

/// The order of the rays of several pixels. by_direction: consecutive rays are as close in direction as can be.
/// as_alone: each pixel's rays keep the order that they have without the other pixels. All pixels must then have the
/// same number of rays, and consecutive rays are less close.
enum class RayOrder { by_direction, as_alone };

/// The rays of several pixels, sorted by position on the disk below the hemisphere: consecutive rays, of whichever
/// pixel, have similar directions and hit similar geometry. A pixel's rays do not depend on the other pixels.
class HemisphereSamples {
 public:
  static constexpr std::size_t max_pixels = 64;
  static constexpr std::size_t sources = max_pixels * max_randomisations;

  void make(const TruthParams& params, const Hemisphere& hemisphere, std::span<const PixelRays> pixels,
            RayOrder ray_order = RayOrder::by_direction);

  std::size_t size() const { return points_.size() - packet_width; }
  /// The ray's pixel and randomisation in one number.
  std::size_t source(std::size_t ray) const { return source_[ray]; }
  static std::size_t source_of(std::size_t pixel, std::size_t randomisation) {
    return pixel * max_randomisations + randomisation;
  }
  static std::size_t pixel_of(std::size_t source) { return source / max_randomisations; }
  static std::size_t randomisation_of(std::size_t source) { return source % max_randomisations; }

  /// Writes packet_width rays from `first` on. Lanes after the last ray get the direction of the axis from the first
  /// pixel.
  void lift(std::size_t first, const RayLanes& to, LiftedLanes& lifted) const;

 private:
  using Source = std::uint16_t;
  static_assert(sources <= 1u << 16u);

  void order(std::size_t strata);

  Hemisphere hemisphere_;
  AoWeight weight_ = AoWeight::cosine;
  std::array<vec3, max_pixels> origins_{};
  // Before and after sorting; the sorted ones are padded by a packet.
  std::vector<vec2> made_points_, points_;  // on the disk
  std::vector<Source> made_source_, source_;
  std::vector<std::uint16_t> made_stratum_;
  std::vector<std::uint32_t> next_;  // sorted index of a stratum's next point
  std::vector<float> u_, v_;         // on the square, of one randomisation
};

}  // namespace umbrameter
