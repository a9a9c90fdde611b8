#include "raytrace/randomized_estimate.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/quantiles.h"

namespace umbrameter {
namespace {

// −ln 0.05: see min_half_width().
constexpr double rule_of_three = 2.995732273553991;

// The scatter of each half has 7 degrees of freedom, that of the pilot 15: the ratio of the two is below 1.5 in nine of
// ten cases (F distribution). By aiming that far below the tolerance, most pixels stop at the first check.
constexpr double margin = 1.5;

// The power of the error by which the number of rays grows. For an edge, the error falls as n^(−3/4) with scrambled
// points (He and Owen, Extensible grids: uniform sampling on a space filling curve, 2016, for discontinuous integrands
// in two dimensions), and as n^(−1/2) with random ones.
double ray_exponent(Sampler sampler) { return sampler == Sampler::owen ? 4.0 / 3.0 : 2.0; }

int round_up(double points) {
  const auto whole = static_cast<unsigned>(std::max(std::ceil(points), 1.0));
  const unsigned step = std::max(std::bit_floor(whole) / 4u, 1u);
  return static_cast<int>((whole + step - 1u) / step * step);
}

}  // namespace

double RandomizedEstimate::mean() const {
  double sum = 0.0;
  for (int r = 0; r < split.count; ++r) sum += open[static_cast<std::size_t>(r)];
  return sum / split.points;
}

double RandomizedEstimate::variance() const {
  // One randomisation has no scatter: use the largest variance of a value in [0, 1].
  if (split.count < 2) return 0.25;
  double sum = 0.0;
  for (int r = 0; r < split.count; ++r) sum += open[static_cast<std::size_t>(r)] / split.size(r);
  const double center = sum / split.count;
  double squares = 0.0;
  for (int r = 0; r < split.count; ++r) {
    const double off = open[static_cast<std::size_t>(r)] / split.size(r) - center;
    squares += off * off;
  }
  return squares / (split.count - 1.0) / split.count;
}

RandomizedEstimate half_of(const RandomizedEstimate& estimate, int half) {
  RandomizedEstimate part;
  part.effective_share = estimate.effective_share;
  part.split = {estimate.split.count / 2, 0};
  for (int r = 0; r < part.split.count; ++r) {
    const int from = half * part.split.count + r;
    part.split.points += estimate.split.size(from);
    part.open[static_cast<std::size_t>(r)] = estimate.open[static_cast<std::size_t>(from)];
  }
  return part;
}

double min_half_width(const RandomizedEstimate& estimate) {
  return std::min(rule_of_three / (estimate.effective_share * estimate.split.points), 1.0);
}

double standard_error(const RandomizedEstimate& estimate) {
  const double quantile = student_95(estimate.split.count - 1.0);
  return std::max(quantile * std::sqrt(estimate.variance()), min_half_width(estimate)) / quantile;
}

int rays_needed(const RandomizedEstimate& pilot, const TruthParams& params) {
  const double scatter = student_95(pilot.split.count - 1.0) * std::sqrt(pilot.variance());
  const double factor = std::pow(margin * scatter / params.tolerance, ray_exponent(params.sampler));
  const double rays = std::max(pilot.split.points * factor, rule_of_three / (pilot.effective_share * params.tolerance));
  return max_randomisations * round_up(std::min<double>(rays, params.max_spp) / max_randomisations);
}

Randomisations pilot_of(const TruthParams& params) { return {max_randomisations, params.min_spp / 2}; }

}  // namespace umbrameter
