// What the ray tracer returns: images of the reference, how accurate they are and what they cost. Plain values, without
// Embree.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

struct BuildStatistics {
  std::uint64_t triangles = 0;  ///< over all instances
  double seconds = 0.0;
  std::uint64_t bytes = 0;  ///< by Embree's memory monitor
};

/// The cost of a trace, and the largest offset of its rays.
struct TraceStatistics {
  std::uint64_t rays = 0;
  double seconds = 0.0;
  double largest_offset = 0.0;  ///< metres, along the geometric normal, over all surfels
  bool from_cache = false;      ///< not traced now; `seconds` is the time of the original trace

  /// Adds the rays of another part of the same image.
  void add(const TraceStatistics& part) {
    rays += part.rays;
    largest_offset = std::max(largest_offset, part.largest_offset);
  }
};

/// The accuracy of the sampled pixels of an image.
struct SamplingPrecision {
  std::uint64_t pixels = 0;       ///< sampled ones
  double worst_half_width = 0.0;  ///< of the pixels' 95 % intervals
  double mean_half_width = 0.0;
  double mean_samples = 0.0;          ///< per pixel, of TracedAo::samples or TracedVisibility::samples
  std::uint64_t pixels_at_limit = 0;  ///< stopped by truth.max-spp above the tolerance; 0 without a tolerance
};

struct TracedVisibility {
  Image<float> visibility;  ///< 1 lit, 0 blocked or back-facing (geometric N·L ≤ 0), 1 on the background
  TraceStatistics statistics;
  /// For a light with extent, as in TracedAo; 0 where nothing was sampled: on the background, on back-facing surfels
  /// and inside a sphere light. Empty for a light without extent.
  Image<float> standard_error{};
  Image<float> variance{};
  Image<float> samples{};  ///< points on the light, with the pilot's; those below the horizon need no ray
  int degrees_of_freedom = 0;
  SamplingPrecision precision{};
};

struct TracedAo {
  Image<float> ao;  ///< accessibility, 1 open and on background
  /// Half width of each pixel's 95 % interval, divided by student_95(degrees_of_freedom). Never 0 on a surface, because
  /// rays that all agree may have missed something (docs/reference.md). 0 on the background.
  Image<float> standard_error;
  Image<float> variance;       ///< unbiased estimate for each pixel, for sums over many pixels; 0 if its rays agree
  Image<float> samples;        ///< rays of each pixel, with the pilot's
  Image<vec3> bent_normal;     ///< unit, world: weighted mean of the open directions; 0 if none is open. Or empty
  Image<float> hit_distance;   ///< metres, mean over the blocked rays; infinite without any. Or empty
  int degrees_of_freedom = 0;  ///< of each pixel's standard error
  SamplingPrecision precision;
  TraceStatistics statistics;
};

}  // namespace umbrameter
