#include "experiments/measure.h"

namespace umbrameter {

SampledImage sampled(const TracedVisibility& truth) {
  return {truth.visibility, truth.variance, truth.samples, truth.degrees_of_freedom};
}

ShadowMeasurement measure_shadow(Workbench& workbench, const Experiment& experiment, std::uint32_t light, Sides sides) {
  const LightFit& fit = workbench.fit(experiment, light);
  const Light lamp = workbench.light(experiment, light);
  const bool is_soft = is_area(lamp);
  ShadowMeasurement measurement;
  measurement.experiment = experiment;
  measurement.light = light;
  measurement.frame = fit.frame;
  measurement.counted = fit.counted;
  measurement.emitter = lamp.emitter;
  if (sides.truth) measurement.truth = workbench.truth(experiment, light);
  if (sides.raster) measurement.raster = workbench.draw(experiment, light, sides.truth && !is_soft);
  if (!sides.raster || !sides.truth) return measurement;
  const Image<float>& drawn = measurement.raster->visibility;
  const TracedVisibility& truth = *measurement.truth;
  if (is_soft) {
    measurement.soft_statistics = analyze_soft_visibility(drawn, sampled(truth), measurement.counted);
  } else {
    WrongTaps& wrong = measurement.raster->wrong;
    if (experiment.run.classes == ClassRule::exact) measurement.agreement = workbench.judge(experiment, light, wrong);
    measurement.statistics = analyze_visibility(wrong, truth.visibility, measurement.counted);
    const GBuffer& gbuffer = workbench.surfels(experiment.view).gbuffer;
    const auto by_part = [&](PartKind kind) {
      return errors_by_part(workbench.scene(), kind, gbuffer, wrong, measurement.counted);
    };
    measurement.objects = by_part(PartKind::object);
    measurement.materials = by_part(PartKind::material);
  }
  return measurement;
}

AoMeasurement measure_ao(Workbench& workbench, const Experiment& experiment, Sides sides) {
  AoMeasurement measurement;
  measurement.experiment = experiment;
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
