#include "experiments/measure/measure.h"

#include <functional>

#include "experiments/measure/measure_biases.h"
#include "experiments/measure/metric_scores.h"
#include "scenes/shading.h"

namespace umbrameter {

namespace {

std::vector<MetricScore> score_of(const Experiment& experiment, bool is_shadow,
                                  const std::function<ComparedImages()>& images) {
  const std::vector<MetricColumn> columns = metric_columns(experiment.run, is_shadow);
  return columns.empty() ? std::vector<MetricScore>{} : score(columns, images());
}

void measure_causes(Stages& stages, ShadowMeasurement& measurement) {
  const Experiment& experiment = measurement.experiment;
  WrongTaps& wrong = measurement.raster->wrong;
  if (experiment.run.classes == ClassRule::exact && !stages.has_engine()) {
    measurement.agreement = stages.reclassify(experiment, measurement.light, wrong);
  }
  if (stages.has_engine()) measurement.cause_source = stages.engine_causes(experiment, measurement.light)->source;
  measurement.statistics = analyze_visibility(wrong, measurement.truth->visibility, measurement.counted);
  const auto surfels = stages.surfels(experiment);
  const auto by_part = [&](PartKind kind) {
    return errors_by_part(stages.scene(), kind, surfels->gbuffer, wrong, measurement.counted);
  };
  measurement.objects = by_part(PartKind::object);
  measurement.materials = by_part(PartKind::material);
}

}  // namespace

EdgeStatistics measure_edges(Stages& stages, const Experiment& experiment, std::uint32_t light,
                             const Image<float>& drawn) {
  const Light lamp = stages.light(experiment, light);
  const auto surfels = stages.surfels(experiment);
  const auto truth = stages.truth(experiment, light);
  const auto counted = stages.counted(experiment, light);
  const auto layout = stages.layout(experiment, light);
  const ShapeInput input{surfels->gbuffer, truth->visibility, *counted, lamp, *layout};
  return analyze_edges(input, drawn, analyze_error_shape(input, drawn));
}

Image<vec3> picture_of(const Stages& stages, const Measurement& measurement) {
  if (const auto& image = measurement.image) {
    Image<vec3> picture = image->raster ? image->raster->radiance : *image->truth;
    for (vec3& color : picture.pixels) color *= static_cast<float>(image->experiment.shading.exposure);
    return picture;
  }
  std::vector<LitBy> lights;
  for (const ShadowMeasurement& shadow : measurement.shadows) {
    const Image<float>& visibility = shadow.raster ? shadow.raster->visibility : shadow.truth->visibility;
    lights.push_back({&stages.scene().lights[shadow.light], &visibility});
  }
  const Image<float>* ao = nullptr;
  if (measurement.ao) ao = measurement.ao->raster ? &*measurement.ao->raster : &measurement.ao->truth->ao;
  return shade(measurement.surfels.gbuffer, lights, ao);
}

ShadowMeasurement measure_shadow(Stages& stages, const Experiment& experiment, std::uint32_t light, Sides sides) {
  const Light lamp = stages.light(experiment, light);
  const bool is_sampled = stages.is_sampled(experiment, light);
  const bool has_causes = !is_sampled && stages.capabilities(experiment).sums_comparisons;
  ShadowMeasurement measurement;
  measurement.experiment = experiment;
  measurement.light = light;
  measurement.layout = *stages.layout(experiment, light);
  measurement.depth_unit = mean_depth_unit(stages, experiment, light);
  measurement.counted = *stages.counted(experiment, light);
  measurement.emitter = lamp.emitter;
  measurement.is_sampled = is_sampled;
  if (sides.truth) measurement.truth = *stages.truth(experiment, light);
  if (sides.raster) {
    measurement.raster = stages.draw(experiment, light, sides.truth && has_causes);
    if (!stages.has_engine()) measurement.stored_depths = *stages.stored_depths(experiment, light);
  }
  if (!sides.raster || !sides.truth) return measurement;
  const Image<float>& drawn = measurement.raster->visibility;
  if (has_causes) {
    measure_causes(stages, measurement);
  } else if (is_sampled) {
    measurement.statistics = analyze_soft_visibility(drawn, sampled(*measurement.truth), measurement.counted);
  } else {
    measurement.statistics = measure_edges(stages, experiment, light, drawn);
  }
  measurement.metrics =
      score_of(experiment, true, [&] { return compared_visibility(stages, experiment, light, drawn); });
  return measurement;
}

AoMeasurement measure_ao(Stages& stages, const Experiment& experiment, Sides sides) {
  AoMeasurement measurement;
  measurement.experiment = experiment;
  if (sides.truth) measurement.truth = *stages.ao_truth(experiment);
  if (sides.raster) measurement.raster = stages.draw_ao(experiment);
  if (sides.raster && sides.truth) {
    const TracedAo& truth = *measurement.truth;
    measurement.statistics =
        analyze_ao(*measurement.raster, {truth.ao, truth.variance, truth.samples, truth.degrees_of_freedom},
                   stages.surfels(experiment)->gbuffer);
    measurement.metrics =
        score_of(experiment, false, [&] { return compared_ao(stages, experiment, *measurement.raster); });
  }
  return measurement;
}

}  // namespace umbrameter
