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

void measure_parts(Stages& stages, ShadowMeasurement& measurement) {
  const auto surfels = stages.surfels(measurement.experiment);
  const auto by_part = [&](PartKind kind) {
    return errors_by_part(stages.scene(), kind, surfels->gbuffer, measurement.raster->wrong, measurement.counted);
  };
  measurement.objects = by_part(PartKind::object);
  measurement.materials = by_part(PartKind::material);
}

}  // namespace

ShadowKind kind_of(const Stages& stages, const Experiment& experiment, std::uint32_t light) {
  if (stages.is_sampled(experiment, light)) return ShadowKind::sampled;
  return stages.capabilities(experiment).sums_comparisons ? ShadowKind::by_cause : ShadowKind::by_edges;
}

ShadowStatistics analyze_shadow(Stages& stages, const Experiment& experiment, std::uint32_t light, ShadowKind kind,
                                const RasterVisibility& drawn, const CountedPixels& counted) {
  const auto truth = stages.truth(experiment, light);
  if (kind == ShadowKind::by_cause) return analyze_visibility(drawn.wrong, truth->visibility, counted);
  if (kind == ShadowKind::sampled) return analyze_soft_visibility(drawn.visibility, sampled(*truth), counted);
  const Light lamp = stages.light(experiment, light);
  const auto surfels = stages.surfels(experiment);
  const auto layout = stages.layout(experiment, light);
  const ShapeInput input{surfels->gbuffer, truth->visibility, counted, lamp, *layout};
  return analyze_edges(input, drawn.visibility, analyze_error_shape(input, drawn.visibility));
}

RasterVisibility draw_causes(Stages& stages, const Experiment& experiment, std::uint32_t light,
                             std::optional<ClassAgreement>& agreement) {
  RasterVisibility drawn = stages.draw(experiment, light, true);
  if (experiment.run.classes == ClassRule::exact && !stages.has_engine()) {
    agreement = stages.reclassify(experiment, light, drawn.wrong);
  }
  return drawn;
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
  const ShadowKind kind = kind_of(stages, experiment, light);
  ShadowMeasurement measurement;
  measurement.experiment = experiment;
  measurement.light = light;
  measurement.layout = *stages.layout(experiment, light);
  measurement.depth_unit = mean_depth_unit(stages, experiment, light);
  measurement.counted = *stages.counted(experiment, light);
  measurement.emitter = stages.light(experiment, light).emitter;
  measurement.is_sampled = kind == ShadowKind::sampled;
  if (sides.truth) measurement.truth = *stages.truth(experiment, light);
  if (sides.raster) {
    measurement.raster = sides.truth && kind == ShadowKind::by_cause
                             ? draw_causes(stages, experiment, light, measurement.agreement)
                             : stages.draw(experiment, light, false);
    if (!stages.has_engine()) measurement.stored_depths = *stages.stored_depths(experiment, light);
  }
  if (!sides.raster || !sides.truth) return measurement;
  const RasterVisibility& drawn = *measurement.raster;
  measurement.statistics = analyze_shadow(stages, experiment, light, kind, drawn, measurement.counted);
  if (kind == ShadowKind::by_cause) {
    if (stages.has_engine()) measurement.cause_source = stages.engine_causes(experiment, light)->source;
    measure_parts(stages, measurement);
  }
  measurement.metrics =
      score_of(experiment, true, [&] { return compared_visibility(stages, experiment, light, drawn.visibility); });
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
