#include "compare/ao.h"

#include <cassert>

namespace umbrameter {

AoStatistics analyze_ao(const Image<float>& raster, const SampledImage& truth, const GBuffer& gbuffer) {
  assert(raster.size() == gbuffer.instance.size());
  return {analyze_sampled(raster, truth, [&](std::size_t i) { return gbuffer.is_surface(i); })};
}

Statistics describe(AoStatistics& statistics) {
  SampledError& s = statistics.error;
  return StatisticsDescription()
      .field("pixels", s.pixels, "px", "pixels that see a surface")
      .field("mae", s.mae, "1", with_bounds("mean absolute error of accessibility"),
             {"Mean absolute error of accessibility", "mean absolute error [%], bounds"})
      .field("rmse", s.rmse, "1", "RMS error, corrected for the variance of the reference",
             {"RMS error of accessibility", "RMS error [%], 95 % interval"})
      .field("mean_error", s.mean_error, "1", "mean signed error, technique − reference",
             {"Mean signed error of accessibility", "technique − reference [%], 95 % interval"})
      .share("mean_raster", s.mean_raster, "mean accessibility of the technique")
      .field("mean_truth", s.mean_truth, "1", "mean accessibility of the reference")
      .field("max_error", s.max_error, "1", "largest absolute error, including the noise of the reference")
      .take();
}

}  // namespace umbrameter
