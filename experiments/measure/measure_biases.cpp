#include "experiments/measure/measure_biases.h"

#include <algorithm>

#include "compare/bias_response.h"
#include "raytrace/casters.h"
#include "scenes/floor.h"

namespace umbrameter {

std::vector<std::vector<VisibilityStatistics>> measure_biases(Stages& stages, const Experiment& experiment,
                                                              std::uint32_t light, const std::vector<double>& constant,
                                                              const std::vector<double>& slope) {
  BiasAxes axes;
  axes.unit = experiment.shadow.bias.constant.unit;
  for (const double bias : constant) axes.constant.push_back(static_cast<float>(bias));
  for (const double factor : slope) axes.slope.push_back(static_cast<float>(factor));
  std::ranges::sort(axes.constant);
  axes.constant.erase(std::unique(axes.constant.begin(), axes.constant.end()), axes.constant.end());

  const BiasHistogram histogram = stages.bias_response(experiment, light, axes);
  const auto traced = stages.truth(experiment, light);
  const TruthCounts truth = count_truth(traced->visibility, *stages.counted(experiment, light));
  std::vector<std::vector<VisibilityStatistics>> measured(slope.size());
  for (std::size_t s = 0; s < slope.size(); ++s) {
    const std::vector<VisibilityStatistics> ascending = statistics_at_biases(histogram, s, truth);
    for (const double bias : constant) {
      const auto found = std::lower_bound(axes.constant.begin(), axes.constant.end(), static_cast<float>(bias));
      measured[s].push_back(ascending[static_cast<std::size_t>(found - axes.constant.begin())]);
    }
  }
  return measured;
}

double mean_depth_unit(Stages& stages, const Experiment& experiment, std::uint32_t light) {
  const MapLayout layout = with_depth_encoding(*stages.layout(experiment, light), experiment.shadow.map_depth);
  const bool is_own = experiment.shadow.fit.cascade_bias == own_range && layout.kind == MapKind::orthographic;
  if (layout.encoded_near == 0.0 && !is_own) return layout.far_depth;
  const auto counted = stages.counted(experiment, light);
  const auto surfels = stages.surfels(experiment);
  double sum = 0.0;
  for (std::size_t i = 0; i < counted->exclusion.size(); ++i) {
    if (counted->exclusion[i] != PixelExclusion::none) continue;
    const dvec3 position(surfels->gbuffer.position[i]);
    const auto share = [&] {
      return layout.views[view_of(layout, dvec3(layout.light_from_world * dvec4(position, 1.0)))].range_share;
    };
    sum += (is_own ? share() : 1.0) * metres_per_map_depth(layout, depth_of(layout, position));
  }
  const std::uint64_t pixels = counted->totals[static_cast<std::size_t>(PixelExclusion::none)];
  return pixels > 0 ? sum / static_cast<double>(pixels) : 0.0;
}

BiasFacts measure_bias_facts(Stages& stages, const Experiment& experiment, std::uint32_t light) {
  const ShadowTechnique technique = make_technique(experiment.shadow);
  const FilterKernel* kernel = kernel_of(technique);
  if (kernel == nullptr) return {};
  const auto surfels = stages.surfels(experiment);
  const auto layout = stages.layout(experiment, light);
  const auto counted = stages.counted(experiment, light);
  return measure_facts(surfels->gbuffer, *layout, *counted, experiment.shadow.map_depth, *kernel);
}

BiasEvidence measure_bias_evidence(Stages& stages, const Experiment& experiment, std::uint32_t light) {
  const auto counted = stages.counted(experiment, light);
  const auto truth = stages.truth(experiment, light);
  const TruthCounts counts = count_truth(truth->visibility, *counted);
  BiasEvidence evidence{counts.pixels, counts.lit, counts.pixels - counts.lit, has_floor(stages.scene()), true};
  if (evidence.has_floor) return evidence;
  const auto surfels = stages.surfels(experiment);
  const GBuffer& gbuffer = surfels->gbuffer;
  const TracedCasters casters = trace_casters(stages.tracer(), gbuffer, stages.light(experiment, light));
  const std::vector<Instance>& instances = stages.scene().instances;
  std::uint64_t on_others = 0;
  for (std::size_t i = 0; i < truth->visibility.size(); ++i) {
    if (counted->exclusion[i] != PixelExclusion::none || casters.instance[i] == no_id) continue;
    if (instances[casters.instance[i]].object != instances[gbuffer.instance[i]].object) ++on_others;
  }
  evidence.is_on_others = 2 * on_others > evidence.blocked;
  return evidence;
}

}  // namespace umbrameter
