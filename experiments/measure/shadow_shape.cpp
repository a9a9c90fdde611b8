#include "experiments/measure/shadow_shape.h"

#include <utility>

#include "experiments/measure/map_views.h"
#include "raytrace/casters.h"

namespace umbrameter {
ShadowShape measure_shape(Stages& stages, const ShadowMeasurement& shadow) {
  const Experiment& experiment = shadow.experiment;
  const auto surfels = stages.surfels(experiment);
  const auto hard_truth = shadow.is_sampled ? stages.hard_truth(experiment, shadow.light) : nullptr;
  const Light light = stages.light(experiment, shadow.light);
  const ShapeInput input{surfels->gbuffer,
                         shadow.truth->visibility,
                         shadow.counted,
                         light,
                         shadow.layout,
                         &shadow.truth->variance,
                         hard_truth ? &hard_truth->visibility : nullptr};
  const VisibilityStatistics* causes = by_cause(shadow);
  if (causes == nullptr) {
    ShadowShape shape{analyze_error_shape(input, shadow.raster->visibility)};
    if (!shadow.is_sampled) shape.error.outside_penumbra.reset();
    if (!stages.has_engine()) shape.views = measure_map_views(stages, shadow);
    return shape;
  }
  const TracedCasters traced = trace_casters(stages.tracer(), surfels->gbuffer, light);
  const RasterVisibility& raster = *shadow.raster;
  CasterShapes casters = analyze_casters(
      {input, raster.visibility, raster.wrong, traced.instance, traced.distance, stages.scene(), surfels->view});
  const std::string missing = missing_contacts_text(casters.search);
  if (!missing.empty() && causes->peter_panning > 0.0) {
    stages.add_notes({stages.title(shadow.light) + ": " + missing});
  }
  return {analyze_error_shape(input, raster.wrong), std::move(casters.casters), casters.search, std::nullopt,
          stages.has_engine() ? MapViews{} : measure_map_views(stages, shadow)};
}

}  // namespace umbrameter
