#include "compare/ao.h"

#include <cassert>

namespace umbrameter {

AoStatistics analyze_ao(const Image<float>& raster, const SampledImage& truth, const GBuffer& gbuffer) {
  assert(raster.size() == gbuffer.instance.size());
  return analyze_sampled(raster, truth, [&](std::size_t i) { return gbuffer.is_surface(i); });
}

std::vector<Column> ao_columns() {
  return {
      {"pixels", "px", "pixels that see a surface"},
      {"mae", "1", "mean absolute error of accessibility"},
      {"mae_lo", "1", "lower end of its 95 % interval"},
      {"mae_hi", "1", "upper end of its 95 % interval"},
      {"rmse", "1", "root mean square error, corrected for the variance of the reference"},
      {"rmse_lo", "1", "lower end of its 95 % interval"},
      {"rmse_hi", "1", "upper end of its 95 % interval"},
      {"mean_error", "1", "mean of raster − truth"},
      {"mean_error_lo", "1", "lower end of its 95 % interval"},
      {"mean_error_hi", "1", "upper end of its 95 % interval"},
      {"mean_raster", "1", "mean accessibility by the rasteriser"},
      {"mean_truth", "1", "mean accessibility by the reference"},
      {"mean_truth_lo", "1", "lower end of its 95 % interval"},
      {"mean_truth_hi", "1", "upper end of its 95 % interval"},
      {"max_error", "1", "largest absolute error, noise of the reference included"},
  };
}

std::vector<Value> to_row(const AoStatistics& s) {
  return {static_cast<std::int64_t>(s.pixels),
          s.mae.value,
          s.mae.lower,
          s.mae.upper,
          s.rmse.value,
          s.rmse.lower,
          s.rmse.upper,
          s.mean_error.value,
          s.mean_error.lower,
          s.mean_error.upper,
          s.mean_raster,
          s.mean_truth.value,
          s.mean_truth.lower,
          s.mean_truth.upper,
          s.max_error};
}

}  // namespace umbrameter
