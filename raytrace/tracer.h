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
#include "scenes/scene.h"
#include "scenes/view.h"
#include "techniques/truth/parameters.h"
#include "techniques/truth/traced.h"

namespace umbrameter {

/// Embree's version, "3.13.5".
std::string embree_version();
/// Version of the loaded library, which may be newer than the one at build time: "31305". Throws as Tracer does.
std::string loaded_embree_version();

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

/// Primary hits through the pixel centres of the view, without back faces of single-sided materials.
GBuffer trace_gbuffer(const Tracer& tracer, const View& view, const Progress& progress = {});

/// How visibility of area lights is sampled.
struct TruthSampling {
  TruthParams params;
  std::uint32_t seed = 1;
};

/// For a light without extent: 0 or 1, by one ray. For a light with extent: the visible share of its area or solid
/// angle (params.light_sampling), regardless of its direction and cone, from as many points as trace_ao() traces rays.
/// Points below the surfel's geometric horizon count as blocked and need no ray. 1 for a surfel inside a sphere light.
TracedVisibility trace_visibility(const Tracer& tracer, const GBuffer& gbuffer, const Light& light,
                                  const TruthSampling& sampling = {}, const Progress& progress = {});

/// Hemisphere AO. Without a tolerance: params.spp rays per pixel. With a tolerance: a pilot of params.min_spp / 2 rays
/// predicts the number of rays; new rays are then traced until the half width of the 95 % interval is within the
/// tolerance or params.max_spp is reached (docs/reference.md). Throws Error (usage) when parameters contradict one
/// another.
TracedAo trace_ao(const Tracer& tracer, const GBuffer& gbuffer, const TruthParams& params, std::uint32_t seed,
                  const Progress& progress = {});

}  // namespace umbrameter
