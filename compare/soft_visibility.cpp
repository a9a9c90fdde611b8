#include "compare/soft_visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "compare/error_sums.h"
#include "core/parallel.h"

namespace umbrameter {
namespace {

// A pixel's part of the penumbra, and how it changes with the measured visibility.
struct PenumbraPixel {
  double weight = 0.0;
  double error = 0.0;     // weighted
  double excess = 0.0;    // what noise may have added to `error`, because |raster − v| is never negative
  double variance = 0.0;  // of the measured visibility
  double weight_slope = 0.0;
  double error_slope = 0.0;
};

PenumbraPixel penumbra_pixel(double raster, const SampledImage& truth, std::size_t i, double reach) {
  const double v = truth.value[i];
  const double error = std::abs(raster - v);
  PenumbraPixel pixel;
  pixel.variance = truth.variance.empty() ? 0.0 : static_cast<double>(truth.variance[i]);
  pixel.weight = penumbra_weight(v, pixel.variance);
  pixel.error = penumbra_error(raster, v, pixel.variance);
  pixel.weight_slope = 4.0 * (1.0 - 2.0 * v);
  pixel.error_slope = pixel.weight_slope * error + (raster < v ? pixel.weight : -pixel.weight);
  const double s = std::sqrt(pixel.variance);
  pixel.excess = pixel.weight * possible_excess(error, s, reach, most_excess(raster));
  return pixel;
}

struct PenumbraSums {
  double weight = 0.0;
  double error = 0.0;
  double excess = 0.0;
  double min_samples = std::numeric_limits<double>::infinity();
};

// A variance of a sum of independent pixels, and the sum of the squares of theirs.
struct NoiseSums {
  double variance = 0.0;
  double squares = 0.0;
  void add(double of_pixel) {
    variance += of_pixel;
    squares += of_pixel * of_pixel;
  }
  void add(const NoiseSums& part) {
    variance += part.variance;
    squares += part.squares;
  }
};

// The sums of visit(pixel index, sums of its row) over the counted pixels, in an order that no thread changes.
template <class Sums, class Visit>
std::vector<Sums> sum_rows(const CountedPixels& counted, const Visit& visit) {
  const auto width = static_cast<std::size_t>(counted.exclusion.width);
  std::vector<Sums> rows(static_cast<std::size_t>(counted.exclusion.height));
  parallel_for(rows.size(), [&](std::size_t y) {
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      if (counted.exclusion[i] == PixelExclusion::none) visit(i, rows[y]);
    }
  });
  return rows;
}

void add_penumbra(SoftVisibilityStatistics& statistics, const Image<float>& raster, const SampledImage& truth,
                  const CountedPixels& counted) {
  const double reach = noise_reach(truth.degrees_of_freedom);
  PenumbraSums sums;
  const auto rows = sum_rows<PenumbraSums>(counted, [&](std::size_t i, PenumbraSums& row) {
    const PenumbraPixel pixel = penumbra_pixel(raster[i], truth, i, reach);
    row.weight += pixel.weight;
    row.error += pixel.error;
    row.excess += pixel.excess;
    const double samples = truth.samples.empty() ? 0.0 : static_cast<double>(truth.samples[i]);
    if (samples > 0.0) row.min_samples = std::min(row.min_samples, samples);
  });
  for (const PenumbraSums& row : rows) {
    sums.weight += row.weight;
    sums.error += row.error;
    sums.excess += row.excess;
    sums.min_samples = std::min(sums.min_samples, row.min_samples);
  }
  // A light share of 3/N that all rays missed has a weight of up to four times that.
  const double unseen = 4.0 * unseen_share(sums.min_samples);
  const auto estimate = [&](double value, double scale, double least, const auto& slope_of) {
    NoiseSums noise;
    const auto noise_rows = sum_rows<NoiseSums>(counted, [&](std::size_t i, NoiseSums& row) {
      const PenumbraPixel pixel = penumbra_pixel(raster[i], truth, i, reach);
      const double slope = slope_of(pixel);
      row.add(slope * slope * pixel.variance);
    });
    for (const NoiseSums& row : noise_rows) noise.add(row);
    const double half_width =
        scale * std::max(half_width_of_sum(noise.variance, noise.squares, truth.degrees_of_freedom), least);
    return Estimate{value, std::max(value - half_width, 0.0), value + half_width};
  };
  const double scale = 1.0 / static_cast<double>(statistics.error.pixels);
  statistics.penumbra =
      estimate(sums.weight * scale, scale, unseen, [](const PenumbraPixel& p) { return p.weight_slope; });
  if (!(sums.weight > 0.0)) return;
  const double mean = sums.error / sums.weight;
  // To first order, a ratio of sums changes like its numerator less itself times its denominator.
  statistics.penumbra_mae = estimate(mean, 1.0 / sums.weight, 0.0,
                                     [mean](const PenumbraPixel& p) { return p.error_slope - mean * p.weight_slope; });
  Estimate& error = statistics.penumbra_mae;
  statistics.penumbra_noise = sums.excess / sums.weight;
  error.lower = std::max(error.lower - statistics.penumbra_noise, 0.0);
}

}  // namespace

SoftVisibilityStatistics analyze_soft_visibility(const Image<float>& raster, const SampledImage& truth,
                                                 const CountedPixels& counted) {
  SoftVisibilityStatistics statistics;
  statistics.error =
      analyze_sampled(raster, truth, [&](std::size_t i) { return counted.exclusion[i] == PixelExclusion::none; });
  statistics.mean_texel = counted.mean_texel;
  if (statistics.error.pixels > 0) add_penumbra(statistics, raster, truth, counted);
  return statistics;
}
Statistics describe(SoftVisibilityStatistics& s) {
  return StatisticsDescription()
      .field("pixels", s.error.pixels, "px",
             "counted pixels: they face the light (of an area light at least a part) and lie inside its map, cone and "
             "range")
      .field("lit", s.error.mean_truth, "1", "mean visibility of the reference")
      .field("penumbra", s.penumbra, "1",
             "share of partly lit pixels (those in the penumbra of an area light), each weighted by 4V(1 − V), V the "
             "visibility of the reference; a penumbra in which V rises linearly counts with 2/3 of its area")
      .field("mae", s.error.mae, "1", with_bounds("mean absolute error of visibility"),
             {"Mean absolute error of visibility", "mean absolute error [%], bounds"})
      .field("rmse", s.error.rmse, "1", "RMS error, corrected for the variance of the reference")
      .field("mean_error", s.error.mean_error, "1", "mean signed error, technique − reference")
      .field("false_blocked", s.error.too_dark, "1",
             with_bounds("part of the mean absolute error where the technique is too dark"),
             {"Too dark", "too dark [% of counted pixels], bounds"})
      .field("false_lit", s.error.too_bright, "1",
             with_bounds("part of the mean absolute error where the technique is too bright"),
             {"Too bright", "too bright [% of counted pixels], bounds"})
      .share("mean_raster", s.error.mean_raster, "mean visibility of the technique")
      .field("max_error", s.error.max_error, "1", "largest absolute error, including the noise of the reference")
      .field("mean_texel", s.mean_texel, "m", mean_texel_meaning)
      .field("penumbra_mae", s.penumbra_mae, "1",
             with_bounds("mean absolute error of visibility of partly lit pixels, each weighted by 4V(1 − V)"),
             {"Error in the penumbra", "mean absolute error in the penumbra [%], bounds"})
      .take();
}

}  // namespace umbrameter
