#include "techniques/ao/integral.h"

#include <algorithm>
#include <cmath>

namespace umbrameter {
namespace {

double smoothstep(double x) {
  const double s = std::clamp(x, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

// The range check of the techniques that compare depths: it fades occluders whose depth differs by more than the
// radius. A hit within the radius never does.
double range_check(const SsaoParams& params, double radius, double depth_difference) {
  return params.range_check ? smoothstep(radius / std::max(depth_difference, 1e-20)) : 1.0;
}

// The share of the kernel's points that lie farther along their direction than x · radius: distances are ξ · (0.1 +
// 0.9 u²) for uniform ξ and u (hemisphere_kernel()), so it is ∫ max(0, 1 − x / (0.1 + 0.9 u²)) du from 0 to 1.
double kernel_share_beyond(double x) {
  if (x >= 1.0) return 0.0;
  const double from = x > 0.1 ? std::sqrt((x - 0.1) / 0.9) : 0.0;
  return 1.0 - from - x / 0.3 * (std::atan(3.0) - std::atan(3.0 * from));
}

double unchanged(double accessibility) { return accessibility; }

std::function<double(double)> with_intensity(double intensity) {
  return [intensity](double accessibility) { return std::max(1.0 - intensity * (1.0 - accessibility), 0.0); };
}

}  // namespace

// A point of the kernel counts as hidden where a surface lies between it and the surfel.
AoIntegral integral_of(const Ssao& technique) {
  const double radius = technique.sampling.radius.number;
  const SsaoParams params = technique.params;
  const auto occlusion = [=](const AoHit& hit) {
    return kernel_share_beyond(hit.along_ray / radius) * range_check(params, radius, hit.depth_difference);
  };
  return {AoDirections::uniform, radius, occlusion, unchanged,
          "uniform directions; a hit at x = distance / radius occludes by the share of the kernel's points beyond x"};
}

// As of hemisphere SSAO, but the points fill the ball evenly, and half of it lies below the surface.
AoIntegral integral_of(const Crytek& technique) {
  const double radius = technique.sampling.radius.number;
  const SsaoParams params = technique.range;
  const auto occlusion = [=](const AoHit& hit) {
    const double x = hit.along_ray / radius;
    return std::max(1.0 - x * x * x, 0.0) * range_check(params, radius, hit.depth_difference);
  };
  return {
      AoDirections::uniform, radius, occlusion, [](double accessibility) { return 0.5 * accessibility; },
      "uniform directions; a hit at x = distance / radius occludes by 1 − x³, the share of the ball's points beyond "
      "x; halved, because the lower half of the ball is below the surface"};
}

AoIntegral integral_of(const Gtao& technique) {
  const GtaoParams params = technique.params;
  const double radius = technique.sampling.radius.number * params.radius_multiplier;
  const auto occlusion = [=](const AoHit& hit) {
    const double stretch = (1.0 + params.thin_compensation) * (1.0 + params.thin_compensation) - 1.0;
    const double range = std::sqrt(hit.distance * hit.distance + stretch * hit.depth_difference * hit.depth_difference);
    return std::clamp((radius - range) / std::max(radius * params.falloff_range, 1e-20), 0.0, 1.0);
  };
  return {AoDirections::cosine, radius, occlusion,
          [power = params.power](double accessibility) { return std::pow(std::max(accessibility, 0.0), power); },
          "cosine-weighted directions; a hit occludes in full up to the start of the falloff, from there linearly to 0 "
          "at radius × multiplier; the result is raised to the power"};
}

AoIntegral integral_of(const Hbao& technique) {
  const HbaoParams params = technique.params;
  const double radius = technique.sampling.radius.number;
  const double bias = params.tangent_bias * pi / 180.0;
  const auto occlusion = [=](const AoHit& hit) {
    const double x = hit.distance / radius;
    return hit.above_tangent < bias ? 0.0 : std::max(1.0 - x * x, 0.0);
  };
  return {AoDirections::uniform, radius, occlusion, with_intensity(params.intensity),
          "uniform directions; a hit at x = distance / radius occludes by 1 − x², unless its direction is lower above "
          "the tangent plane than the tangent bias; times the intensity"};
}

// The derivation of the papers: the mean over uniform directions of the estimator's own term at the first hit.
AoIntegral integral_of(const Alchemy& technique) {
  const AlchemyParams params = technique.params;
  const double radius = technique.sampling.radius.number;
  const auto occlusion = [=](const AoHit& hit) {
    const double square = hit.distance * hit.distance;
    const double limit = radius * radius;
    if (square >= limit) return 0.0;
    const double height = std::max(hit.distance * hit.cosine - params.bias * radius, 0.0);
    const double term = radius * height / (square + 1e-4 * limit);
    if (params.estimator == AlchemyEstimator::alchemy) return 2.0 * term;
    const double rest = 1.0 - square / limit;
    return 5.0 * rest * rest * rest * term;
  };
  return {AoDirections::uniform, radius, occlusion, with_intensity(params.intensity),
          "uniform directions; the first hit adds the estimator's own term, which exceeds 1 near by; times the "
          "intensity, cut at 0"};
}

AoIntegral integral_of(const Marched& technique) {
  const bool is_uniform = technique.params.weight == MarchedWeight::uniform;
  const double radius = technique.sampling.radius.number;
  const auto occlusion = [thickness = technique.params.thickness * radius](const AoHit& hit) {
    return hit.behind <= thickness ? 1.0 : 0.0;
  };
  return {is_uniform ? AoDirections::uniform : AoDirections::cosine, radius, occlusion, unchanged,
          std::string(is_uniform ? "uniform" : "cosine-weighted") +
              " directions; a hit within the radius occludes in full, and so does a seen surface that the ray is "
              "behind by at most the thickness along the camera's axis"};
}

std::optional<AoIntegral> integral_of(const Bitmask& technique) {
  if (technique.params.weight == BitmaskWeight::angle) return {};
  const double radius = technique.sampling.radius.number;
  const double thickness = technique.params.thickness * radius;
  // A sample covers the directions between its point and the point as much as the thickness farther from the viewer.
  const auto occlusion = [=](const AoHit& hit) {
    return hit.distance < radius && hit.behind_to_viewer <= thickness ? 1.0 : 0.0;
  };
  return AoIntegral{AoDirections::cosine,
                    radius,
                    occlusion,
                    unchanged,
                    "cosine-weighted directions; a hit within the radius occludes in full, and so does a seen point "
                    "within the radius that the ray is behind by at most the thickness, along the direction to the "
                    "viewer",
                    {},
                    thickness};
}

std::optional<AoIntegral> find_integral(const AoTechnique& technique) {
  return std::visit([](const auto& each) -> std::optional<AoIntegral> { return integral_of(each); }, technique);
}

AoParams with_many_samples(AoParams params) {
  params.sampling.samples = 1024;
  params.noise.size = 16;
  params.slices.slices = 16;
  params.slices.steps = 32;
  params.hbao.directions = 32;
  params.hbao.steps = 32;
  // Without a common factor with the number of samples; about as many turns as samples in one turn.
  params.alchemy.turns = 37;
  params.blur.kind = AoBlur::none;
  params.resolution.kind = AoResolution::full;
  return params;
}

}  // namespace umbrameter
