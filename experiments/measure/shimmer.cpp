#include "experiments/measure/shimmer.h"

#include <algorithm>
#include <array>

#include "experiments/measure/measure.h"
#include "scenes/emitter.h"

namespace umbrameter {
namespace {

// Quarters and halves of a texel or pixel, along one axis and along both.
const std::array<dvec2, 4> moves = {dvec2(0.25, 0.25), dvec2(0.5, 0.0), dvec2(0.0, 0.5), dvec2(0.5, 0.5)};

void add(Flips& sum, const Flips& flips) {
  sum.pixels += flips.pixels;
  sum.share += flips.share;
}

Flips mean_of(Flips sum) { return {sum.pixels / moves.size(), sum.share / static_cast<double>(moves.size())}; }

}  // namespace

Image<float> draw_visibility_with(Stages& stages, const ShadowMeasurement& shadow, const MapLayout& layout,
                                  const GpuGBuffer& surfels, const View& view) {
  const Experiment& experiment = shadow.experiment;
  const gl::Context& context = stages.context();
  const UploadedScene& scene = stages.uploaded();
  const Light light = stages.light(experiment, shadow.light);
  const ShadowTechnique technique = make_technique(experiment.shadow, half_size(light.emitter));
  const ShadowMap map = draw_shadow_map(context, scene, light, layout, experiment.shadow.map_depth);
  const TechniqueMap filtered = filter_map({context, scene, light, map, experiment.shadow.map_depth}, technique);
  return draw_visibility(context,
                         {scene, surfels, map, light, experiment.shadow.bias, technique, nullptr, &filtered, &view})
      .visibility;
}

Shimmer measure_shimmer(Stages& stages, const ShadowMeasurement& shadow) {
  const Experiment& experiment = shadow.experiment;
  const gl::Context& context = stages.context();
  const UploadedScene& scene = stages.uploaded();
  const auto surfels = stages.surfels(experiment);
  const auto gpu_surfels = stages.gpu_surfels(experiment);
  const Light light = stages.light(experiment, shadow.light);
  const Image<float>& before = shadow.raster->visibility;

  Shimmer shimmer;
  for (const dvec2& move : moves) {
    const MapLayout shifted = shift_grid(shadow.layout, move, stages.mapped_bounds().all());
    const Image<float> after = draw_visibility_with(stages, shadow, shifted, *gpu_surfels, surfels->view);
    const double share = count_flips(before, after, shadow.counted).share;
    shimmer.grid_mean += share / static_cast<double>(moves.size());
    shimmer.grid_largest = std::max(shimmer.grid_largest, share);
  }

  Flips drawn;
  Flips traced;
  for (const dvec2& move : moves) {
    const View view = shift_view(surfels->view, move);
    const bool is_traced = experiment.view.surfels == SurfelSource::traced;
    const GBuffer moved =
        is_traced ? trace_gbuffer(stages.tracer(), view) : read_back(context, draw_gbuffer(context, scene, view));
    const Image<float> after = draw_visibility_with(stages, shadow, shadow.layout, upload(context, moved), view);
    add(drawn, count_flips(before, after, shadow.counted, surfels->gbuffer, moved));
    if (shadow.is_sampled) continue;
    const Image<float> truth = trace_visibility(stages.tracer(), moved, light).visibility;
    add(traced, count_flips(shadow.truth->visibility, truth, shadow.counted, surfels->gbuffer, moved));
  }
  shimmer.camera = mean_of(drawn);
  if (!shadow.is_sampled) shimmer.camera_truth = mean_of(traced);
  return shimmer;
}

}  // namespace umbrameter
