#include "experiments/measure/map_views.h"

#include <algorithm>
#include <array>

#include "compare/shimmer.h"
#include "experiments/measure/measure.h"
#include "experiments/measure/shimmer.h"

namespace umbrameter {
namespace {

// The camera's steps for FitShimmer: right, up and forward, in texels of the finest view. No whole number, so that a
// fit which does not move in whole texels changes.
constexpr double step_texels = 2.3;
const std::array<dvec3, 3> steps = {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, -1)};

bool follows_camera(const ShadowMeasurement& shadow) {
  return shadow.layout.kind == MapKind::orthographic &&
         (shadow.layout.views.size() > 1 || shadow.experiment.shadow.fit.fit == MapFit::view);
}

SeamStatistics measure_seams(Stages& stages, const ShadowMeasurement& shadow) {
  const Experiment& experiment = shadow.experiment;
  const auto surfels = stages.surfels(experiment);
  const auto gpu_surfels = stages.gpu_surfels(experiment);
  MapLayout layout = shadow.layout;
  layout.blend = 0.0;
  const Image<std::uint8_t> seams = find_seams(surfels->gbuffer, layout, shadow.counted);
  const Image<float> own = draw_visibility_with(stages, shadow, layout, *gpu_surfels, surfels->view);
  layout.uses_neighbour = true;
  const Image<float> neighbour = draw_visibility_with(stages, shadow, layout, *gpu_surfels, surfels->view);
  return analyze_seams(seams, own, neighbour, shadow.counted);
}

FitShimmer measure_fit_shimmer(Stages& stages, const ShadowMeasurement& shadow) {
  const Experiment& experiment = shadow.experiment;
  const auto surfels = stages.surfels(experiment);
  const auto gpu_surfels = stages.gpu_surfels(experiment);
  const Light light = stages.light(experiment, shadow.light);
  const bool is_traced = experiment.view.surfels == SurfelSource::traced;
  double finest = shadow.layout.views.front().half_extent;
  for (const MapView& view : shadow.layout.views) finest = std::min(finest, view.half_extent);
  FitShimmer shimmer;
  shimmer.step = step_texels * 2.0 * finest / shadow.layout.resolution;
  for (const dvec3& step : steps) {
    View view = surfels->view;
    view.camera.world_from_camera[3] = view.camera.world_from_camera * dvec4(shimmer.step * step, 1.0);
    const GBuffer seen = is_traced
                             ? trace_gbuffer(stages.tracer(), view)
                             : read_back(stages.context(), draw_gbuffer(stages.context(), stages.uploaded(), view));
    const MapLayout layout =
        fit_map(light, stages.mapped_bounds(), experiment.shadow.map, {seen, view}, experiment.shadow.fit);
    CountedPixels both = count_pixels(surfels->gbuffer, light, layout);
    for (std::size_t i = 0; i < both.exclusion.size(); ++i) {
      if (shadow.counted.exclusion[i] != PixelExclusion::none) both.exclusion[i] = shadow.counted.exclusion[i];
    }
    const Image<float> after = draw_visibility_with(stages, shadow, layout, *gpu_surfels, surfels->view);
    const Flips flips = count_flips(shadow.raster->visibility, after, both);
    shimmer.pixels += flips.pixels;
    shimmer.mean_change += flips.share / static_cast<double>(steps.size());
    shimmer.largest_change = std::max(shimmer.largest_change, flips.share);
  }
  return shimmer;
}

}  // namespace

MapViews measure_map_views(Stages& stages, const ShadowMeasurement& shadow) {
  MapViews measured;
  const Experiment& experiment = shadow.experiment;
  if (shadow.layout.views.size() > 1) {
    const Light light = stages.light(experiment, shadow.light);
    const auto surfels = stages.surfels(experiment);
    const ShapeInput input{surfels->gbuffer, shadow.truth->visibility, shadow.counted, light, shadow.layout};
    measured.views =
        analyze_views(input, shadow.raster->visibility, by_cause(shadow) != nullptr ? &shadow.raster->wrong : nullptr);
    measured.seams = measure_seams(stages, shadow);
  }
  if (experiment.run.shimmer && follows_camera(shadow)) measured.shimmer = measure_fit_shimmer(stages, shadow);
  return measured;
}

}  // namespace umbrameter
