#include "compare/bias_facts.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "techniques/shadow/reference/lookup.h"

namespace umbrameter {
namespace {

constexpr std::size_t max_samples = 65'536;
constexpr std::size_t samples_per_task = 1024;

// Counted pixels, evenly spaced.
std::vector<std::size_t> sample_counted(const CountedPixels& counted) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < counted.exclusion.size(); ++i) {
    if (counted.exclusion[i] == PixelExclusion::none) all.push_back(i);
  }
  const std::size_t step = (all.size() + max_samples - 1) / max_samples;
  std::vector<std::size_t> samples;
  for (std::size_t i = 0; i < all.size(); i += step) samples.push_back(all[i]);
  return samples;
}

// The value that 90 % do not exceed.
double percentile_90(std::vector<double> values) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>((9 * values.size() + 9) / 10 - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

double reach_of(const FilterKernel& kernel) {
  if (kernel.search) return std::numeric_limits<double>::quiet_NaN();
  if (kernel.is_grid()) return 0.5 * (kernel.side() - 1);
  double farthest = 0.0;
  for (const vec2& point : kernel.points) farthest = std::max(farthest, static_cast<double>(glm::length(point)));
  return farthest * static_cast<double>(kernel.radius);
}

double depth_per_texel_at(const MapLayout& layout, const dvec3& position, const dvec3& normal) {
  Receiver receiver = project_to_map(layout, position);
  receiver.plane = dvec3(layout.light_from_world * dvec4(normal, 0.0));
  const auto along = [&](const ivec2& axis) {
    const std::optional<double> ahead = plane_depth(layout, receiver, receiver.texel + axis, receiver.view);
    const std::optional<double> behind = plane_depth(layout, receiver, receiver.texel - axis, receiver.view);
    return ahead && behind ? 0.5 * std::abs(*ahead - *behind) : std::numeric_limits<double>::infinity();
  };
  return along({1, 0}) + along({0, 1});
}

BiasFacts measure_facts(const GBuffer& gbuffer, const MapLayout& layout, const CountedPixels& counted,
                        const MapDepthParams& depth, const FilterKernel& kernel) {
  BiasFacts facts;
  facts.radius = reach_of(kernel);
  const std::vector<std::size_t> samples = sample_counted(counted);
  if (samples.empty()) return facts;
  std::vector<double> slopes(samples.size());
  std::vector<double> steps(samples.size());
  parallel_for((samples.size() + samples_per_task - 1) / samples_per_task, [&](std::size_t task) {
    const std::size_t end = std::min(samples.size(), (task + 1) * samples_per_task);
    for (std::size_t i = task * samples_per_task; i < end; ++i) {
      const dvec3 position(gbuffer.position[samples[i]]);
      slopes[i] = depth_per_texel_at(layout, position, dvec3(gbuffer.geometric_normal[samples[i]]));
      steps[i] = depth_step(depth, layout, depth_of(layout, position));
    }
  });
  facts.depth_per_texel = percentile_90(std::move(slopes));
  for (const double step : steps) facts.depth_step += step / static_cast<double>(steps.size());
  return facts;
}

}  // namespace umbrameter
