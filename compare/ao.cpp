#include "compare/ao.h"

#include <cassert>
#include <utility>

namespace umbrameter {

AoStatistics analyze_ao(const Image<float>& raster, const SampledImage& truth, const GBuffer& gbuffer) {
  assert(raster.size() == gbuffer.instance.size());
  return analyze_sampled(raster, truth, [&](std::size_t i) { return gbuffer.is_surface(i); });
}

std::vector<Column> ao_columns() {
  std::vector<Column> columns = {{"pixels", "px", "pixels that see a surface"}};
  add_estimate(columns, "mae", "mean absolute error of accessibility");
  add_estimate(columns, "rmse", "root mean square error, corrected for the variance of the reference");
  add_estimate(columns, "mean_error", "mean of technique − reference");
  columns.push_back({"mean_raster", "1", "mean accessibility of the technique"});
  add_estimate(columns, "mean_truth", "mean accessibility of the reference");
  columns.push_back({"max_error", "1", "largest absolute error, including the noise of the reference"});
  return columns;
}

std::vector<Value> to_row(const AoStatistics& s) {
  std::vector<Value> row = {static_cast<std::int64_t>(s.pixels)};
  add_estimate(row, s.mae);
  add_estimate(row, s.rmse);
  add_estimate(row, s.mean_error);
  row.emplace_back(s.mean_raster);
  add_estimate(row, s.mean_truth);
  row.emplace_back(s.max_error);
  return measured_row(std::move(row), s.pixels);
}

}  // namespace umbrameter
