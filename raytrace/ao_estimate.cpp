#include "raytrace/ao_estimate.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/quantiles.h"

namespace umbrameter {
namespace {

// −ln 0.05: see least_half_width().
constexpr double rule_of_three = 2.995732273553991;

// Scatters of 7 degrees of freedom must come below the tolerance, from what a pilot of 15 has told: by chance their
// ratio is below 1.5 in nine of ten cases (F distribution). Aiming that much lower makes most pixels stop at their
// first look.
constexpr double margin = 1.5;

// Error of scrambled points across an edge falls as n^(−3/4) (He and Owen, Extensible grids: uniform sampling on a
// space filling curve, 2016, for discontinuous integrands in two dimensions), of random ones as n^(−1/2).
double rays_per_error(Sampler sampler) { return sampler == Sampler::owen ? 4.0 / 3.0 : 2.0; }

int round_up(double points) {
  const auto whole = static_cast<unsigned>(std::max(std::ceil(points), 1.0));
  const unsigned step = std::max(std::bit_floor(whole) / 4u, 1u);
  return static_cast<int>((whole + step - 1u) / step * step);
}

}  // namespace

double AoEstimate::mean() const {
  double sum = 0.0;
  for (int r = 0; r < split.count; ++r) sum += open[static_cast<std::size_t>(r)];
  return sum / split.points;
}

double AoEstimate::variance() const {
  // One randomisation tells nothing of its scatter: then the largest that a value in [0, 1] can have.
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

AoEstimate half_of(const AoEstimate& estimate, int half) {
  AoEstimate part;
  part.worth = estimate.worth;
  part.split = {estimate.split.count / 2, 0};
  for (int r = 0; r < part.split.count; ++r) {
    const int from = half * part.split.count + r;
    part.split.points += estimate.split.size(from);
    part.open[static_cast<std::size_t>(r)] = estimate.open[static_cast<std::size_t>(from)];
  }
  return part;
}

double least_half_width(const AoEstimate& estimate) {
  return std::min(rule_of_three / (estimate.worth * estimate.split.points), 1.0);
}

double standard_error(const AoEstimate& estimate) {
  const double quantile = student_95(estimate.split.count - 1.0);
  return std::max(quantile * std::sqrt(estimate.variance()), least_half_width(estimate)) / quantile;
}

int rays_needed(const AoEstimate& seen, const TruthParams& params) {
  const double scatter = student_95(seen.split.count - 1.0) * std::sqrt(seen.variance());
  const double factor = std::pow(margin * scatter / params.tolerance, rays_per_error(params.sampler));
  const double rays = std::max(seen.split.points * factor, rule_of_three / (seen.worth * params.tolerance));
  const double most = params.max_spp;
  return most_randomisations * round_up(std::min(rays, most) / most_randomisations);
}

Randomisations pilot_of(const TruthParams& params) { return {most_randomisations, params.min_spp / 2}; }

}  // namespace umbrameter
