// The reference, traced by Embree: primary hits, shadow rays and hemisphere ambient occlusion, for the same surfels
// that the rasteriser draws. Only raytrace/*.cpp includes Embree's headers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>

#include "core/gbuffer.h"
#include "core/image.h"
#include "core/parallel.h"
#include "raytrace/parameters.h"
#include "scenes/scene.h"
#include "scenes/view.h"

namespace umbrameter {

/// Embree's version, "3.13.5".
std::string embree_version();
/// Version of the loaded library, which may be newer than the one at build time: "31305". Throws as Tracer does.
std::string loaded_embree_version();

struct BuildStatistics {
  std::uint64_t triangles = 0;  ///< over all instances
  double seconds = 0.0;
  std::uint64_t bytes = 0;  ///< by Embree's memory monitor
};

/// Acceleration structures of one scene. They refer to the scene's vertices and triangles, so the scene must outlive
/// them unchanged. Read-only after construction; any thread may trace.
class Tracer {
 public:
  /// Throws Error (no_backend) when Embree does not start or runs out of memory, and when the user interrupts.
  explicit Tracer(const Scene& scene, const Progress& progress = {});
  ~Tracer();
  Tracer(Tracer&&) noexcept;
  Tracer& operator=(Tracer&&) noexcept;

  const Scene& scene() const;
  const BuildStatistics& build_statistics() const;
  /// Shadow and AO rays traced so far, updated after each tile; for progress displays.
  std::uint64_t rays_traced() const;

  struct State;
  const State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
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

/// Primary hits through the pixel centres of the view, without back faces of single-sided materials.
GBuffer trace_gbuffer(const Tracer& tracer, const View& view, const Progress& progress = {});

/// How visibility of area lights is sampled.
struct TruthSampling {
  TruthParams params;
  std::uint32_t seed = 1;
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
/// For a light without extent: 0 or 1, by one ray. For a light with extent: the visible share of its area or solid
/// angle (params.light_sampling), regardless of its direction and cone, from as many points as trace_ao() traces rays.
/// Points below the surfel's geometric horizon count as blocked and need no ray. 1 for a surfel inside a sphere light.
TracedVisibility trace_visibility(const Tracer& tracer, const GBuffer& gbuffer, const Light& light,
                                  const TruthSampling& sampling = {}, const Progress& progress = {});

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
/// Hemisphere AO. Without a tolerance: params.spp rays per pixel. With a tolerance: a pilot of params.min_spp / 2 rays
/// predicts the number of rays; new rays are then traced until the half width of the 95 % interval is within the
/// tolerance or params.max_spp is reached (docs/reference.md). Throws Error (usage) when parameters contradict one
/// another.
TracedAo trace_ao(const Tracer& tracer, const GBuffer& gbuffer, const TruthParams& params, std::uint32_t seed,
                  const Progress& progress = {});

}  // namespace umbrameter
