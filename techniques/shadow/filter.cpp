#include "techniques/shadow/filter.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parameter_selection.h"
#include "core/random.h"

namespace umbrameter {
namespace {

constexpr int turn_count = 64;
// Sum of a Gaussian's weights along a side. Weights are integers, so that sums and histograms of them are exact; the
// square of the sum fits into 32 bits.
constexpr std::uint32_t gaussian_sum = 1u << 15;
// The kernel under linear taps is finer, so that the rounding after them is all that counts; times texel_parts, its sum
// fits into 32 bits.
constexpr std::uint32_t linear_gaussian_sum = 1u << 23;

std::vector<std::uint32_t> tent(int size) {
  std::vector<std::uint32_t> weights;
  for (int i = 0; i < size; ++i) weights.push_back(static_cast<std::uint32_t>(std::min(i, size - 1 - i) + 1));
  return weights;
}

// exp(−x²/2σ²) at the texels' centres. Rounded are the sums of the weights from the left, so that at a straight edge
// the kernel is off by half a unit; what lies right of the middle mirrors the left.
std::vector<std::uint32_t> gaussian(int size, std::uint32_t sum) {
  const double deviation = (size + 1) / 6.0;
  std::vector<double> before = {0.0};
  for (int i = 0; i < size; ++i) {
    const double x = (i - 0.5 * (size - 1)) / deviation;
    before.push_back(before.back() + std::exp(-0.5 * x * x));
  }
  const auto rounded = [&](int i) {
    return static_cast<std::uint32_t>(std::lround(sum * before[static_cast<std::size_t>(i)] / before.back()));
  };
  const auto weight_before = [&](int i) { return 2 * i <= size ? rounded(i) : sum - rounded(size - i); };
  std::vector<std::uint32_t> weights;
  for (int i = 0; i < size; ++i) weights.push_back(weight_before(i + 1) - weight_before(i));
  return weights;
}

// Of ever more candidates, always the one that is farthest from the points so far.
std::vector<vec2> poisson_disk(int count) {
  std::vector<vec2> points;
  std::uint32_t draw = 0;
  for (int i = 0; i < count; ++i) {
    vec2 best(0);
    float farthest = -1.0f;
    for (int candidate = 0; candidate < 32 * (i + 1); ++candidate) {
      vec2 point;
      do {
        point.x = 2.0f * to_unit_float(hash(draw++)) - 1.0f;
        point.y = 2.0f * to_unit_float(hash(draw++)) - 1.0f;
      } while (point.x * point.x + point.y * point.y > 1.0f);
      float nearest = 4.0f;
      for (const vec2& other : points) {
        const vec2 way = point - other;
        nearest = std::min(nearest, way.x * way.x + way.y * way.y);
      }
      if (nearest > farthest) {
        farthest = nearest;
        best = point;
      }
    }
    points.push_back(best);
  }
  return points;
}

// Point i at radius √((i + ½)/n) and i golden angles: equal areas, no two directions alike. (H. Vogel, A better way to
// construct the sunflower head, 1979.)
std::vector<vec2> vogel_disk(int count) {
  const double golden_angle = pi * (3.0 - std::sqrt(5.0));
  std::vector<vec2> points;
  for (int i = 0; i < count; ++i) {
    const double radius = std::sqrt((i + 0.5) / count);
    const double angle = i * golden_angle;
    points.emplace_back(static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle)));
  }
  return points;
}

std::vector<std::uint32_t> optimized(int size) {
  switch (size) {
    case 3:
      return {1, 2, 1};
    case 5:
      return {1, 3, 4, 3, 1};
    case 7:
      return {1, 5, 12, 16, 12, 5, 1};
    default:
      throw Error(ExitCode::usage, "shadow.filter-size", "the optimized kernels have 3, 5 or 7 texels",
                  "choose one of them, or --shadow.filter tent --shadow.filter-taps linear");
  }
}

std::vector<vec2> disk(ShadowFilter filter, int count) {
  return filter == ShadowFilter::poisson ? poisson_disk(count) : vogel_disk(count);
}

std::vector<vec2> even_rotations() {
  std::vector<vec2> rotations;
  for (int i = 0; i < turn_count; ++i) {
    const double angle = 2.0 * pi * i / turn_count;
    rotations.emplace_back(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)));
  }
  return rotations;
}

PcfParams of_disk(PcfParams params) {
  if (params.filter != ShadowFilter::poisson) params.filter = ShadowFilter::vogel;
  return params;
}

}  // namespace

FilterKernel make_filter(const PcfParams& params) {
  FilterKernel filter;
  filter.linear_taps = params.taps == FilterTaps::linear;
  switch (params.filter) {
    case ShadowFilter::nearest:
      filter.linear_taps = false;
      filter.kernel = {1};
      break;
    case ShadowFilter::bilinear:
      filter.linear_taps = true;
      filter.kernel = {1};
      break;
    case ShadowFilter::box:
      filter.kernel.assign(static_cast<std::size_t>(params.size), 1);
      break;
    case ShadowFilter::tent:
      filter.kernel = tent(params.size);
      break;
    case ShadowFilter::gaussian:
      filter.kernel = gaussian(params.size, filter.linear_taps ? linear_gaussian_sum : gaussian_sum);
      if (filter.linear_taps) filter.divisor = linear_gaussian_sum / gaussian_sum * FilterKernel::texel_parts;
      break;
    case ShadowFilter::optimized:
      filter.linear_taps = true;
      filter.kernel = optimized(params.size);
      break;
    case ShadowFilter::area_tent:
      if (params.size > FilterKernel::largest_area_size) {
        throw Error(ExitCode::usage, "shadow.filter-size", "an area tent has at most 7 texels",
                    "choose a smaller size");
      }
      filter.linear_taps = filter.is_area_tent = true;
      filter.kernel.assign(static_cast<std::size_t>(params.size), 1);
      break;
    case ShadowFilter::poisson:
    case ShadowFilter::vogel:
      filter.linear_taps = false;
      filter.points = disk(params.filter, params.samples);
      filter.rotations = even_rotations();
      filter.rotation = params.rotation;
      filter.radius = static_cast<float>(params.radius);
      break;
  }
  return filter;
}

Parameters read_parameters(PcfParams& params) {
  const Parameters all = describe(params);
  switch (params.filter) {
    case ShadowFilter::nearest:
    case ShadowFilter::bilinear:
      return select(all, {"shadow.filter"});
    case ShadowFilter::box:
    case ShadowFilter::tent:
    case ShadowFilter::gaussian:
      return select(all, {"shadow.filter", "shadow.filter-size", "shadow.filter-taps"});
    case ShadowFilter::optimized:
    case ShadowFilter::area_tent:
      return select(all, {"shadow.filter", "shadow.filter-size"});
    case ShadowFilter::poisson:
    case ShadowFilter::vogel:
      break;
  }
  return select(all, {"shadow.filter", "shadow.filter-samples", "shadow.filter-radius", "shadow.filter-rotation"});
}

FilterKernel make_pcss_filter(const PcfParams& params, const PcssParams& pcss, double extent) {
  FilterKernel filter = make_filter(of_disk(params));
  filter.search = {disk(of_disk(params).filter, pcss.blockers), static_cast<float>(extent * pcss.light_scale),
                   static_cast<float>(pcss.max_radius), static_cast<float>(std::min(pcss.min_radius, pcss.max_radius)),
                   pcss.search_cone};
  return filter;
}

FilterKernel make_dpcf_filter(const PcfParams& params, const PcssParams& pcss, double extent) {
  FilterKernel filter = make_filter(of_disk(params));
  filter.hardening = {static_cast<float>(extent * pcss.light_scale), static_cast<float>(pcss.max_radius)};
  return filter;
}

std::vector<std::uint32_t> running_sums(const std::vector<std::uint32_t>& kernel) {
  std::vector<std::uint32_t> sums = {0};
  for (const std::uint32_t weight : kernel) sums.push_back(sums.back() + weight);
  return sums;
}

}  // namespace umbrameter
