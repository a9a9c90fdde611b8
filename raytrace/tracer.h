// The Embree side: primary hits, shadow rays and hemisphere ambient occlusion, answered for the same surfels that
// the rasteriser draws. Embree itself stays in raytrace/*.cpp.
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
/// Of the library that is loaded, which may be newer than the one built with: "31305". Throws as Tracer does.
std::string loaded_embree_version();

struct BuildStatistics {
  std::uint64_t triangles = 0;  ///< over all instances
  double seconds = 0.0;
  std::uint64_t bytes = 0;  ///< as Embree's memory monitor counts
};

/// Acceleration structures of one scene, which must outlive it unchanged: they refer to its vertices and triangles.
/// Read-only once built; any thread may trace.
class Tracer {
 public:
  /// Throws Error (no_backend) when Embree does not start or runs out of memory, and when the user interrupts.
  explicit Tracer(const Scene& scene, const Progress& progress = {});
  ~Tracer();
  Tracer(Tracer&&) noexcept;
  Tracer& operator=(Tracer&&) noexcept;

  const Scene& scene() const;
  const BuildStatistics& build_statistics() const;
  /// Shadow and AO rays so far, tile by tile while they are traced; for showing how fast it goes.
  std::uint64_t rays_traced() const;

  struct State;
  const State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

/// What a trace cost and how far its rays stepped off the surface.
struct TraceStatistics {
  std::uint64_t rays = 0;
  double seconds = 0.0;
  double largest_offset = 0.0;  ///< metres, along the geometric normal, over all surfels
  bool from_cache = false;      ///< not traced now: `seconds` is what it took when it was

  /// Adds the rays of another part of the same image.
  void add(const TraceStatistics& part) {
    rays += part.rays;
    largest_offset = std::max(largest_offset, part.largest_offset);
  }
};

/// Primary hits through the pixel centres of the view, without back faces of single-sided materials.
GBuffer trace_gbuffer(const Tracer& tracer, const View& view, const Progress& progress = {});

/// How what has no closed form is sampled.
struct TruthSampling {
  TruthParams params;
  std::uint32_t seed = 1;
};

/// How well the sampled pixels of an image are known.
struct SamplingPrecision {
  std::uint64_t pixels = 0;       ///< sampled ones
  double worst_half_width = 0.0;  ///< of the pixels' 95 % intervals
  double mean_half_width = 0.0;
  double mean_samples = 0.0;          ///< a pixel, as TracedAo and TracedVisibility count them
  std::uint64_t pixels_at_limit = 0;  ///< stopped by truth.max-spp above the tolerance; 0 without a tolerance
};

struct TracedVisibility {
  Image<float> visibility;  ///< 1 lit, 0 blocked or turned away (geometric N·L ≤ 0), 1 on background
  TraceStatistics statistics;
  /// Of a light with extent as TracedAo has them, 0 where nothing was sampled: on background, turned away and within a
  /// sphere light. Empty of a light without.
  Image<float> standard_error{};
  Image<float> variance{};
  Image<float> samples{};  ///< points on the light, the pilot's too; those below the horizon take no ray
  int degrees_of_freedom = 0;
  SamplingPrecision precision{};
};
/// One ray to a light without extent, whose visibility is 0 or 1. Of a light with extent the visible share, of
/// its area or its solid angle (params.light_sampling), however it is turned and whatever its cone, by as many points
/// as trace_ao() takes rays; points below the surfel's geometric horizon count as blocked and take none. 1 for a surfel
/// within a sphere light.
TracedVisibility trace_visibility(const Tracer& tracer, const GBuffer& gbuffer, const Light& light,
                                  const TruthSampling& sampling = {}, const Progress& progress = {});

struct TracedAo {
  Image<float> ao;  ///< accessibility, 1 open and on background
  /// Half width of each pixel's 95 % interval over student_95(degrees_of_freedom). Never 0 on a surface: rays that all
  /// agree may have missed something (docs/reference.md says how much). 0 on background.
  Image<float> standard_error;
  Image<float> variance;       ///< unbiased estimate of each pixel's, for sums over many pixels; 0 where its rays agree
  Image<float> samples;        ///< rays of each pixel, the pilot's too
  Image<vec3> bent_normal;     ///< unit, world: mean open direction by the weight; 0 where none is open. Or empty
  Image<float> hit_distance;   ///< metres, mean over the blocked rays; infinite where none is. Or empty
  int degrees_of_freedom = 0;  ///< of each pixel's standard error
  SamplingPrecision precision;
  TraceStatistics statistics;
};
/// Hemisphere AO. Without a tolerance params.spp rays a pixel. With one, half of params.min_spp decide how many more
/// are needed, fresh ones make the estimate, and more follow until the half width of its 95 % interval is within the
/// tolerance or params.max_spp is reached; docs/reference.md says how that leaves values unbiased. Throws Error (usage)
/// when parameters contradict one another.
TracedAo trace_ao(const Tracer& tracer, const GBuffer& gbuffer, const TruthParams& params, std::uint32_t seed,
                  const Progress& progress = {});

}  // namespace umbrameter
