// A method's own integral of ambient occlusion by rays, and what is left of it where fewer and fewer occluders exist.
// The same rays serve all of them, so that differences have little noise.
#pragma once

#include <array>
#include <cstdint>

#include "core/gbuffer.h"
#include "core/image.h"
#include "core/parallel.h"
#include "raytrace/tracer.h"
#include "scenes/view.h"
#include "techniques/ao/integral.h"

namespace umbrameter {

/// Which occluders exist. all: the full geometry. in_view: its part inside the view volume, that is all depth layers of
/// the image. seen: the surface of the first layer, without thickness. solid: the same with all behind it assumed
/// solid, as far as the method does (AoHit::behind).
enum class Occluders : int { all, in_view, seen, solid };
inline constexpr std::size_t occluder_kinds = 4;

struct AoIntegralParams {
  int spp = 256;  ///< rays per pixel
  std::uint32_t seed = 1;
};

/// Accessibility by each set of occluders, 1 on background, with unbiased estimates of its variance and of that of its
/// difference from the set before.
struct TracedIntegral {
  std::array<Image<float>, occluder_kinds> accessibility;
  std::array<Image<float>, occluder_kinds> variance;
  std::array<Image<float>, occluder_kinds> step_variance;  ///< of the first set: its own variance
  Image<float> samples;                                    ///< rays of each pixel; 0 on background
  int degrees_of_freedom = 0;
  TraceStatistics statistics;
};

/// Rays leave the exact surfaces of the surfels, as those of trace_ao() do. `view` is that of the G-buffer.
TracedIntegral trace_integral(const Tracer& tracer, const GBuffer& gbuffer, const View& view,
                              const AoIntegral& integral, const AoIntegralParams& params,
                              const Progress& progress = {});

}  // namespace umbrameter
