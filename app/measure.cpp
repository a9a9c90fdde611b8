#include "app/measure.h"

namespace umbrameter {

ShadowMeasurement measure_shadow(Workbench& workbench, const Experiment& experiment, std::uint32_t light, Sides sides) {
  const LightFit& fit = workbench.fit(experiment, light);
  ShadowMeasurement measurement{light, fit.frame, fit.counted, {}, {}, {}};
  if (sides.truth) measurement.truth = workbench.truth(experiment, light);
  if (sides.raster) measurement.raster = workbench.draw(experiment, light, sides.truth);
  if (sides.raster && sides.truth) {
    measurement.statistics = analyze_visibility(measurement.raster->visibility, measurement.truth->visibility,
                                                measurement.raster->classes, measurement.counted);
  }
  return measurement;
}

AoMeasurement measure_ao(Workbench& workbench, const Experiment& experiment, Sides sides) {
  AoMeasurement measurement;
  if (sides.truth) measurement.truth = workbench.ao_truth(experiment);
  if (sides.raster) measurement.raster = workbench.draw_ao(experiment);
  if (sides.raster && sides.truth) {
    const TracedAo& truth = *measurement.truth;
    measurement.statistics =
        analyze_ao(*measurement.raster, {truth.ao, truth.variance, truth.samples, truth.degrees_of_freedom},
                   workbench.surfels(experiment.view).gbuffer);
  }
  return measurement;
}

}  // namespace umbrameter
