#include "raytrace/adaptive_sampling.h"

#include <algorithm>
#include <cmath>

#include "core/quantiles.h"

namespace umbrameter {
namespace {

// The two halves have 7 degrees of freedom each, 14 together. But a pixel stops when its scatter is small, so the
// scatter is slightly too small on average; the larger quantile for 10 compensates. Tests and docs/reference.md give
// the resulting coverage.
constexpr int adaptive_degrees_of_freedom = 10;

bool is_adaptive(const TruthParams& params) { return params.tolerance > 0.0; }

// The next length of a sequence, which must not depend on its values.
int grown(int points) { return points + std::max(points / 4, max_randomisations); }

}  // namespace

AdaptiveSampleCount::AdaptiveSampleCount(const TruthParams& params)
    : is_pilot_(is_adaptive(params)), next_{is_pilot_ ? pilot_of(params) : split(params.spp), 0} {}

bool AdaptiveSampleCount::advance(const TruthParams& params, const RandomizedEstimate& estimate) {
  if (!is_adaptive(params)) {
    estimate_ = {estimate.mean(), estimate.variance(), standard_error(estimate), estimate.split.points};
    return false;
  }
  const int points = estimate.split.points;
  if (is_pilot_) {
    is_pilot_ = false;
    estimate_.rays = points;
    const int needed = std::clamp(rays_needed(estimate, params), params.min_spp - points, params.max_spp - points);
    next_ = {{max_randomisations, needed}, 0};
    return true;
  }
  const int max_points = params.max_spp - estimate_.rays;
  const bool is_last = max_points - points < max_randomisations;
  const RandomizedEstimate parts[] = {half_of(estimate, 0), half_of(estimate, 1)};
  for (const std::size_t i : {0u, 1u}) {
    // The half width of the mean of both halves, if each had the variance of the other half.
    const double width = student_95(adaptive_degrees_of_freedom) * std::sqrt(0.5 * parts[1 - i].variance());
    const bool is_enough = std::max(width, min_half_width(estimate)) <= params.tolerance;
    Half& half = halves_[i];
    if (half.has_stopped || (!is_enough && !is_last)) continue;
    half = {true, parts[i].mean(), parts[i].variance(), parts[1 - i].variance(), min_half_width(estimate)};
  }
  if (!halves_[0].has_stopped || !halves_[1].has_stopped) {
    next_ = {{max_randomisations, std::min(grown(points), max_points)}, points};
    return true;
  }
  estimate_.rays += points;
  conclude();
  return false;
}

void AdaptiveSampleCount::conclude() {
  const auto& [a, b] = halves_;
  estimate_.value = 0.5 * (a.mean + b.mean);
  estimate_.variance = 0.25 * (a.variance + b.variance);
  const double width =
      student_95(adaptive_degrees_of_freedom) * std::sqrt(0.25 * (a.other_variance + b.other_variance));
  estimate_.standard_error =
      std::max(width, std::max(a.min_width, b.min_width)) / student_95(adaptive_degrees_of_freedom);
}

int degrees_of_freedom(const TruthParams& params) {
  return is_adaptive(params) ? adaptive_degrees_of_freedom : split(params.spp).count - 1;
}

SamplingPrecision precision_of(const Image<float>& standard_error, const Image<float>& samples,
                               const TruthParams& params) {
  SamplingPrecision precision;
  const double quantile = student_95(degrees_of_freedom(params));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!(samples[i] > 0.0f)) continue;
    const double half_width = std::min(quantile * static_cast<double>(standard_error[i]), 1.0);  // of a share
    ++precision.pixels;
    precision.worst_half_width = std::max(precision.worst_half_width, half_width);
    precision.mean_half_width += half_width;
    precision.mean_samples += samples[i];
    if (is_adaptive(params) && half_width > params.tolerance) ++precision.pixels_at_limit;
  }
  if (precision.pixels == 0) return precision;
  precision.mean_half_width /= static_cast<double>(precision.pixels);
  precision.mean_samples /= static_cast<double>(precision.pixels);
  return precision;
}

}  // namespace umbrameter
