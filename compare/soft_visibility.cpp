#include "compare/soft_visibility.h"

#include <utility>

namespace umbrameter {

SoftVisibilityStatistics analyze_soft_visibility(const Image<float>& raster, const SampledImage& truth,
                                                 const CountedPixels& counted) {
  const auto is_counted = [&](std::size_t i) { return counted.exclusion[i] == PixelExclusion::none; };
  SoftVisibilityStatistics statistics;
  statistics.error = analyze_sampled(raster, truth, is_counted);
  const SampledError in_penumbra = analyze_sampled(
      raster, truth, [&](std::size_t i) { return is_counted(i) && truth.value[i] > 0.0f && truth.value[i] < 1.0f; });
  const std::uint64_t pixels = statistics.error.pixels;
  statistics.penumbra = pixels > 0 ? static_cast<double>(in_penumbra.pixels) / static_cast<double>(pixels) : 0.0;
  statistics.penumbra_mae = in_penumbra.mae;
  statistics.mean_texel = counted.mean_texel;
  return statistics;
}

Statistics describe(SoftVisibilityStatistics& s) {
  const std::string conservative =
      "; the lower end is conservative: it is corrected for about twice the noise of the reference";
  return StatisticsDescription()
      .field("pixels", s.error.pixels, "px",
             "counted pixels: they face part of the light and lie inside its map, cone and range")
      .field("lit", s.error.mean_truth, "1", "mean visibility of the reference")
      .share("penumbra", s.penumbra, "share in the penumbra: neither lit nor blocked in the reference")
      .field("mae", s.error.mae, "1", "mean absolute error of visibility",
             {"Mean absolute error of visibility", "mean absolute error [%], 95 % interval"})
      .field("rmse", s.error.rmse, "1", "root mean square error, corrected for the variance of the reference")
      .field("mean_error", s.error.mean_error, "1", "mean of technique − reference")
      .field("false_blocked", s.error.too_dark, "1",
             "part of the mean absolute error where the technique is too dark" + conservative,
             {"Too dark", "too dark [% of counted pixels], 95 % interval"})
      .field("false_lit", s.error.too_bright, "1",
             "part of the mean absolute error where the technique is too bright" + conservative,
             {"Too bright", "too bright [% of counted pixels], 95 % interval"})
      .share("mean_raster", s.error.mean_raster, "mean visibility of the technique")
      .field("max_error", s.error.max_error, "1", "largest absolute error, including the noise of the reference")
      .field("mean_texel", s.mean_texel, "m", mean_texel_meaning)
      .field("penumbra_mae", s.penumbra_mae, "1", "mean absolute error of visibility in the penumbra",
             {"Error in the penumbra", "mean absolute error in the penumbra [%], 95 % interval"})
      .take();
}

}  // namespace umbrameter
