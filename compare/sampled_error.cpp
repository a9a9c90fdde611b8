#include "compare/sampled_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "compare/error_sums.h"
#include "core/math.h"
#include "core/parallel.h"
#include "core/quantiles.h"

namespace umbrameter {
namespace {

// −ln 0.05: rays that all agree miss a larger share than this over their number with a probability below 5 %.
constexpr double rule_of_three = 2.995732273553991;

void add(PartSums& sum, const PartSums& part) {
  sum.low += part.low;
  sum.low_variance += part.low_variance;
  sum.low_squares += part.low_squares;
  sum.variance += part.variance;
  sum.variance_squares += part.variance_squares;
}

// A bound on what noise adds to an absolute error, and how it changes with the measured error.
//
// The heat equation says how E|e + √v·sZ| grows with the noise: d/dv = s·φ(e/s; v), where φ(x; v) is the normal density
// of variance v. Up to v = 1 it is at most s·φ(e/s; 1)/√v, so noise adds at most 2s·φ(e/s; 1): all of that where e = 0,
// and twice what it adds where true errors are equally likely on either side of zero. A kernel of width τ at the
// measured error is, on average, φ(e/s; 1 + τ²), which times √(1 + τ²) is nowhere below φ(e/s; 1).
struct NoiseBound {
  double value = 0.0;
  double slope = 0.0;
};

NoiseBound noise_bound(double error, double s, int degrees_of_freedom) {
  if (s <= 0.0) return {};
  constexpr double width = 0.5;  // τ: narrower ones are noisier, wider ones larger
  const double r = error / (width * s);
  // Standard errors are estimates, too: on average they are 1/(4·degrees) too small (Johnson and Kotz 1970, 13.8).
  const double small = degrees_of_freedom > 0 ? 1.0 + 0.25 / degrees_of_freedom : 1.0;
  const double value = 2.0 * small * std::sqrt((1.0 + width * width) / (2.0 * pi)) / width * s * std::exp(-0.5 * r * r);
  return {value, -r / (width * s) * value};
}

// Adds a pixel whose error away from zero in the part's direction is `error`, with the noise's share of |error|.
// A variance is bounded by the mean square of the slope times the noise's variance (Chernoff 1981, Poincaré's
// inequality for the normal distribution).
void add_part(PartSums& part, double error, double variance, const NoiseBound& noise) {
  const double slope = error >= 0.0 ? 1.0 : 0.0;
  const double low_slope = slope - 0.5 * noise.slope;
  const double low_variance = low_slope * low_slope * variance;
  part.low += std::max(error, 0.0) - 0.5 * noise.value;
  part.low_variance += low_variance;
  part.low_squares += low_variance * low_variance;
  part.variance += slope * variance;
  part.variance_squares += slope * variance * variance;
}

ErrorSums sum_row(int y, const Image<float>& raster, const SampledImage& truth, const IsCounted& is_counted) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double negligible = 0.01;  // of the noise: a technique that shows all or nothing but for rounding
  ErrorSums sums;
  const double reach = noise_reach(truth.degrees_of_freedom);
  for (int x = 0; x < raster.width; ++x) {
    const std::size_t i = raster.index(x, y);
    if (!is_counted(i)) continue;
    const double error = static_cast<double>(raster[i]) - static_cast<double>(truth.value[i]);
    const double variance = truth.variance.empty() ? 0.0 : static_cast<double>(truth.variance[i]);
    const double s = std::sqrt(variance);
    ++sums.pixels;
    sums.raster += raster[i];
    sums.truth += truth.value[i];
    sums.error += error;
    sums.absolute += std::abs(error);
    const double most = truth.is_share ? most_excess(static_cast<double>(raster[i])) : infinity;
    sums.absolute_bias += possible_excess(error, s, reach, most);
    sums.squared += error * error;
    sums.squared_noise += error * error * variance;
    sums.variance += variance;
    // The measured error decides elsewhere: the less of the two bounds would, on average, be too little.
    const NoiseBound noise = most < negligible * s ? NoiseBound{most} : noise_bound(error, s, truth.degrees_of_freedom);
    add_part(sums.too_bright, error, variance, noise);
    add_part(sums.too_dark, -error, variance, {noise.value, -noise.slope});
    sums.variance_squared += variance * variance;
    const double samples = truth.samples.empty() ? 0.0 : static_cast<double>(truth.samples[i]);
    if (samples > 0.0) sums.min_samples = std::min(sums.min_samples, samples);
    if (std::abs(error) > sums.max_error) {
      sums.max_error = std::abs(error);
      sums.max_x = x;
    }
  }
  return sums;
}

// For a sum, from its pixels' variances and their squares.
double quantile_of(double variance, double squares, int degrees_of_freedom) {
  if (squares <= 0.0) return student_95(degrees_of_freedom);
  return student_95(degrees_of_freedom * variance * variance / squares);
}

// Of the sum of ê² − v̂, which estimates the squared errors e²: ê = e + √v·Z is measured, and v̂ estimates v with d
// degrees of freedom, independently. A pixel has the variance 4e²v + 2v² + 2v²/d. As ê²v̂ is (e² + v)v on average, and
// v̂² is (1 + 2/d)v², the sum of 4ê²v̂ − 2(1 − 1/d)/(1 + 2/d)·v̂² is that without bias; 2(1 + 1/d)/(1 + 2/d)·v̂² is its
// least, where the technique is right. Single pixels may be below theirs: cut off, they would add up to too much.
double variance_of_squares(const ErrorSums& total, int degrees_of_freedom) {
  const double inverse = degrees_of_freedom > 0 ? 1.0 / degrees_of_freedom : 0.0;
  const double scale = 2.0 * total.variance_squared / (1.0 + 2.0 * inverse);
  return std::max(4.0 * total.squared_noise - (1.0 - inverse) * scale, (1.0 + inverse) * scale);
}

Estimate estimate_part(double value, const PartSums& part, int degrees_of_freedom, double unseen) {
  const auto half_width = [&](double variance, double squares) {
    return std::max(half_width_of_sum(variance, squares, degrees_of_freedom), unseen);
  };
  const double lower = part.low - half_width(part.low_variance, part.low_squares);
  return {value, std::clamp(lower, 0.0, value), value + half_width(part.variance, part.variance_squares)};
}

}  // namespace

double folded_excess(double e, double s) {
  if (s <= 0.0) return 0.0;
  const double r = std::abs(e) / s;
  return s * (std::sqrt(2.0 / pi) * std::exp(-0.5 * r * r) - r * std::erfc(r / std::sqrt(2.0)));
}

double most_excess(double raster) { return 2.0 * std::max(std::min(raster, 1.0 - raster), 0.0); }

double noise_reach(int degrees_of_freedom) { return student_95(degrees_of_freedom); }

double possible_excess(double error, double s, double reach, double most) {
  return std::min(folded_excess(std::max(std::abs(error) - reach * s, 0.0), s), most);
}

double unseen_share(double samples) { return std::min(rule_of_three / samples, 1.0); }

double half_width_of_sum(double variance, double squares, int degrees_of_freedom) {
  return quantile_of(variance, squares, degrees_of_freedom) * std::sqrt(variance);
}

void add(ErrorSums& total, const ErrorSums& part) {
  total.pixels += part.pixels;
  total.raster += part.raster;
  total.truth += part.truth;
  total.error += part.error;
  total.absolute += part.absolute;
  total.absolute_bias += part.absolute_bias;
  total.squared += part.squared;
  total.squared_noise += part.squared_noise;
  total.variance += part.variance;
  total.variance_squared += part.variance_squared;
  add(total.too_dark, part.too_dark);
  add(total.too_bright, part.too_bright);
  total.min_samples = std::min(total.min_samples, part.min_samples);
}

SampledError statistics_of(const ErrorSums& total, int degrees_of_freedom) {
  SampledError statistics;
  statistics.pixels = total.pixels;
  if (total.pixels == 0) return statistics;
  const double scale = 1.0 / static_cast<double>(total.pixels);
  const double quantile = quantile_of(total.variance, total.variance_squared, degrees_of_freedom);
  const double unseen = unseen_share(total.min_samples);
  const double half_width = std::max(quantile * std::sqrt(total.variance), unseen) * scale;
  const auto around = [half_width](double value) { return Estimate{value, value - half_width, value + half_width}; };
  statistics.mean_raster = total.raster * scale;
  statistics.mean_truth = around(total.truth * scale);
  statistics.mean_truth.lower = std::max(statistics.mean_truth.lower, 0.0);
  statistics.mean_error = around(total.error * scale);
  statistics.mae = around(total.absolute * scale);
  statistics.mae_noise = total.absolute_bias * scale;
  // A mean of one sign is at most the mean absolute error, and noise does not raise it.
  const double too_bright_at_least = std::max(statistics.mean_error.lower, 0.0);
  const double too_dark_at_least = std::max(-statistics.mean_error.upper, 0.0);
  statistics.mae.lower =
      std::max({statistics.mae.lower - statistics.mae_noise, too_bright_at_least, too_dark_at_least});
  const auto part = [&](double sum, const PartSums& sums, double at_least) {
    const Estimate estimate = estimate_part(sum, sums, degrees_of_freedom, unseen);
    return Estimate{estimate.value * scale, std::max(estimate.lower * scale, at_least), estimate.upper * scale};
  };
  statistics.too_dark = part(0.5 * (total.absolute - total.error), total.too_dark, too_dark_at_least);
  statistics.too_bright = part(0.5 * (total.absolute + total.error), total.too_bright, too_bright_at_least);
  const double mean_square = (total.squared - total.variance) * scale;
  const double square_half_width = quantile * std::sqrt(variance_of_squares(total, degrees_of_freedom)) * scale;
  const auto root = [](double square) { return std::sqrt(std::max(square, 0.0)); };
  statistics.rmse = {root(mean_square), root(mean_square - square_half_width), root(mean_square + square_half_width)};
  return statistics;
}

SampledError analyze_sampled(const Image<float>& raster, const SampledImage& truth, const IsCounted& is_counted) {
  assert(raster.size() == truth.value.size());
  assert(truth.variance.empty() || raster.size() == truth.variance.size());
  assert(truth.samples.empty() || raster.size() == truth.samples.size());
  std::vector<ErrorSums> rows(static_cast<std::size_t>(raster.height));
  parallel_for(rows.size(), [&](std::size_t y) { rows[y] = sum_row(static_cast<int>(y), raster, truth, is_counted); });
  ErrorSums total;
  int max_y = -1;
  for (std::size_t y = 0; y < rows.size(); ++y) {
    const ErrorSums& row = rows[y];
    add(total, row);
    if (row.max_error > total.max_error) {
      total.max_error = row.max_error;
      total.max_x = row.max_x;
      max_y = static_cast<int>(y);
    }
  }
  SampledError statistics = statistics_of(total, truth.degrees_of_freedom);
  statistics.max_error = total.max_error;
  statistics.max_x = total.max_x;
  statistics.max_y = max_y;
  return statistics;
}

}  // namespace umbrameter
