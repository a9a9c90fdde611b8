#include "compare/soft_visibility.h"

#include <utility>

namespace umbrameter {

SoftVisibilityStatistics analyze_soft_visibility(const Image<float>& raster, const SampledImage& truth,
                                                 const CountedPixels& counted) {
  const auto is_counted = [&](std::size_t i) { return counted.counting[i] == Counting::counted; };
  SoftVisibilityStatistics statistics;
  statistics.error = analyze_sampled(raster, truth, is_counted);
  std::uint64_t between = 0;
  for (std::size_t i = 0; i < truth.value.size(); ++i) {
    if (is_counted(i) && truth.value[i] > 0.0f && truth.value[i] < 1.0f) ++between;
  }
  const std::uint64_t pixels = statistics.error.pixels;
  statistics.penumbra = pixels > 0 ? static_cast<double>(between) / static_cast<double>(pixels) : 0.0;
  statistics.mean_texel = counted.mean_texel;
  return statistics;
}

std::vector<Column> soft_visibility_columns() {
  std::vector<Column> columns = {
      {"pixels", "px", "counted pixels: they face part of the light and lie inside its map, cone and range"}};
  add_estimate(columns, "lit", "mean visibility of the reference");
  columns.push_back({"penumbra", "1", "share in the penumbra: neither lit nor blocked in the reference"});
  add_estimate(columns, "mae", "mean absolute error of visibility");
  add_estimate(columns, "rmse", "root mean square error, corrected for the variance of the reference");
  add_estimate(columns, "mean_error", "mean of technique − reference");
  add_estimate(columns, "false_blocked",
               "part of the mean absolute error where the technique is too dark; the lower end is conservative: it is "
               "corrected for about twice the noise of the reference");
  add_estimate(
      columns, "false_lit",
      "part of the mean absolute error where the technique is too bright; the lower end is conservative: it is "
      "corrected for about twice the noise of the reference");
  columns.push_back({"mean_raster", "1", "mean visibility of the technique"});
  columns.push_back({"max_error", "1", "largest absolute error, including the noise of the reference"});
  columns.push_back(mean_texel_column());
  return columns;
}

std::vector<Value> to_row(const SoftVisibilityStatistics& s) {
  std::vector<Value> row = {static_cast<std::int64_t>(s.error.pixels)};
  add_estimate(row, s.error.mean_truth);
  row.emplace_back(s.penumbra);
  add_estimate(row, s.error.mae);
  add_estimate(row, s.error.rmse);
  add_estimate(row, s.error.mean_error);
  add_estimate(row, s.error.too_dark);
  add_estimate(row, s.error.too_bright);
  row.emplace_back(s.error.mean_raster);
  row.emplace_back(s.error.max_error);
  row.emplace_back(s.mean_texel);
  return measured_row(std::move(row), s.error.pixels);
}

}  // namespace umbrameter
