#include "raytrace/stopping.h"

#include <algorithm>
#include <cmath>

#include "core/quantiles.h"

namespace umbrameter {
namespace {

// Two scatters of 7 degrees of freedom each, which had to come below a limit, and so are a little smaller than scatters
// are on average: the quantile of 10 in place of 14 makes up for that. The tests and docs/reference.md hold what it
// comes to.
constexpr int adaptive_freedom = 10;

bool is_adaptive(const TruthParams& params) { return params.tolerance > 0.0; }

// The steps in which a sequence grows know nothing of what it has shown.
int grown(int points) { return points + std::max(points / 4, most_randomisations); }

}  // namespace

Stopping::Stopping(const TruthParams& params)
    : is_pilot_(is_adaptive(params)), next_{is_pilot_ ? pilot_of(params) : split(params.spp), 0} {}

bool Stopping::advance(const TruthParams& params, const AoEstimate& seen) {
  if (!is_adaptive(params)) {
    estimate_ = {seen.mean(), seen.variance(), standard_error(seen), seen.split.points};
    return false;
  }
  const int points = seen.split.points;
  if (is_pilot_) {
    is_pilot_ = false;
    estimate_.rays = points;
    const int wanted = std::clamp(rays_needed(seen, params), params.min_spp - points, params.max_spp - points);
    next_ = {{most_randomisations, wanted}, 0};
    return true;
  }
  const int most = params.max_spp - estimate_.rays;
  const bool is_last = most - points < most_randomisations;
  const AoEstimate parts[] = {half_of(seen, 0), half_of(seen, 1)};
  for (const std::size_t i : {0u, 1u}) {
    // As if both halves scattered like the other one: variances of the mean of the two.
    const double width = student_95(adaptive_freedom) * std::sqrt(0.5 * parts[1 - i].variance());
    const bool is_enough = std::max(width, least_half_width(seen)) <= params.tolerance;
    Half& half = halves_[i];
    if (half.is_settled || (!is_enough && !is_last)) continue;
    half = {true, parts[i].mean(), parts[i].variance(), parts[1 - i].variance(), least_half_width(seen)};
  }
  if (!halves_[0].is_settled || !halves_[1].is_settled) {
    next_ = {{most_randomisations, std::min(grown(points), most)}, points};
    return true;
  }
  estimate_.rays += points;
  conclude();
  return false;
}

void Stopping::conclude() {
  const auto& [a, b] = halves_;
  estimate_.value = 0.5 * (a.mean + b.mean);
  estimate_.variance = 0.25 * (a.variance + b.variance);
  const double width = student_95(adaptive_freedom) * std::sqrt(0.25 * (a.judged_by + b.judged_by));
  estimate_.standard_error = std::max(width, std::max(a.least_width, b.least_width)) / student_95(adaptive_freedom);
}

int degrees_of_freedom(const TruthParams& params) {
  return is_adaptive(params) ? adaptive_freedom : split(params.spp).count - 1;
}

SamplingPrecision precision_of(const Image<float>& standard_error, const Image<float>& samples,
                               const TruthParams& params) {
  SamplingPrecision precision;
  const double quantile = student_95(degrees_of_freedom(params));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!(samples[i] > 0.0f)) continue;
    const double half_width = quantile * static_cast<double>(standard_error[i]);
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
