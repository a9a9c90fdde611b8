#include "present/summary.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "present/bias_advice_report.h"
#include "present/bias_report.h"
#include "present/presentation_parts.h"
#include "present/scene_report.h"
#include "present/tune_report.h"
#include "reports/files/value_json.h"
#include "results/layers.h"
#include "store/summary_version.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

const char* kind_name(MapKind kind) {
  switch (kind) {
    case MapKind::orthographic:
      return "directional";
    case MapKind::perspective:
      return "spot";
    case MapKind::cube:
    case MapKind::paraboloid:
      return "point";
  }
  return "";
}

Json truth_json(const TraceStatistics& statistics, const SamplingPrecision& precision, int degrees_of_freedom) {
  Json object = {{"rays", statistics.rays}, {"largest_offset_m", statistics.largest_offset}};
  if (precision.pixels == 0) return object;
  object["pixels"] = precision.pixels;
  object["mean_samples"] = precision.mean_samples;
  object["mean_half_width_95"] = precision.mean_half_width;
  object["worst_half_width_95"] = precision.worst_half_width;
  object["pixels_at_limit"] = precision.pixels_at_limit;
  object["degrees_of_freedom"] = degrees_of_freedom;
  return object;
}

Json parts_json(PartKind kind, const std::vector<PartError>& parts, std::uint32_t weight_sum) {
  return rows_json(part_table(kind, parts, weight_sum));
}

Json agreement_json(const ClassAgreement& agreement) {
  return {{"tested_taps", agreement.taps},
          {"wrong_weight", agreement.wrong},
          {"foreign_weight", agreement.unresolved},
          {"reclassified_weight", agreement.reclassified},
          {"reclassified_of_unresolved", share_of_unresolved(agreement)},
          {"reclassified_of_wrong", share_of_wrong(agreement)},
          {"peter_panning_weight", agreement.peter_panning},
          {"peter_panning_on_own_layer", share_on_own_layer(agreement)}};
}

Json place_json(int x, int y) { return x < 0 ? Json(nullptr) : Json{x, y}; }

void add_causes(Json& object, const ShadowMeasurement& shadow, const VisibilityStatistics& s) {
  object["max_error_at_px"] = place_json(s.max_x, s.max_y);
  object["confusion"] = {{"truth_lit_raster_lit", s.lit - s.false_blocked},
                         {"truth_lit_raster_blocked", s.false_blocked},
                         {"truth_blocked_raster_lit", s.false_lit},
                         {"truth_blocked_raster_blocked", s.blocked - s.false_lit}};
  if (!shadow.cause_source.empty()) object["causes"] = shadow.cause_source;
  if (shadow.agreement) object["class_agreement"] = agreement_json(*shadow.agreement);
  const std::uint32_t weight_sum = shadow.raster->wrong.weight_sum;
  object["objects"] = parts_json(PartKind::object, shadow.objects, weight_sum);
  object["materials"] = parts_json(PartKind::material, shadow.materials, weight_sum);
}

void add_stored_depths(Json& map, const StoredDepths& depths) {
  if (depths.range) {
    map["nearest_depth_m"] = depths.range->nearest;
    map["farthest_depth_m"] = depths.range->farthest;
    map["depth_step_at_nearest_m"] = depths.step_at_nearest;
    map["depth_step_at_farthest_m"] = depths.step_at_farthest;
  }
  map["polygon_offset_unit"] = depths.polygon_offset_unit;
}

void add_metrics(Json& object, const std::vector<MetricScore>& scores) {
  for (const MetricScore& scored : scores) object["metrics"][scored.column.name] = scored.score;
}

Json shadow_json(const SceneFacts& scene, const ShadowMeasurement& shadow) {
  Json object;
  object["light"] = scene.title(shadow.light);
  object["layer"] = scene.layer(shadow.light);
  object["index"] = shadow.light;
  object["kind"] = kind_name(shadow.layout.kind);
  object["extent"] = to_json(shadow.emitter);
  const double texel = shadow.counted.mean_texel;
  object["map"] = {{"resolution_texels", shadow.layout.resolution},
                   {"mean_texel_m", texel},
                   {"far_depth_m", shadow.layout.far_depth}};
  if (shadow.stored_depths) add_stored_depths(object["map"], *shadow.stored_depths);
  object["constant_bias"] = to_json(in_units(shadow.experiment.shadow.bias.constant, texel, shadow.depth_unit));
  Json counting = Json::object();
  for (std::size_t i = 0; i < exclusion_names.size(); ++i) {
    counting[std::string(exclusion_names[i])] = shadow.counted.totals[i];
  }
  object["pixels"] = counting;
  if (shadow.truth) {
    const TracedVisibility& truth = *shadow.truth;
    object["truth"] = truth_json(truth.statistics, truth.precision, truth.degrees_of_freedom);
  }
  if (const std::string reason = nothing_counted_text(shadow.counted); !reason.empty()) object["not_measured"] = reason;
  if (shadow.advice) object["recommended_bias"] = to_json(*shadow.advice);
  if (shadow.statistics) {
    const ShadowStatistics& statistics = *shadow.statistics;
    object["statistics"] = std::visit([](const auto& each) { return statistics_json(each); }, statistics);
    if (const auto* soft = std::get_if<SoftVisibilityStatistics>(&statistics)) {
      object["max_error_at_px"] = place_json(soft->error.max_x, soft->error.max_y);
    } else if (const auto* edges = std::get_if<EdgeStatistics>(&statistics)) {
      object["max_error_at_px"] = place_json(edges->max_x, edges->max_y);
    } else {
      add_causes(object, shadow, std::get<VisibilityStatistics>(statistics));
    }
  }
  add_metrics(object, shadow.metrics);
  if (shadow.shape) object["shape"] = to_json(scene, *shadow.shape);
  return object;
}

Json ao_json(const AoMeasurement& ao) {
  Json object;
  if (ao.truth) object["truth"] = truth_json(ao.truth->statistics, ao.truth->precision, ao.truth->degrees_of_freedom);
  if (ao.statistics) {
    const SampledError& error = ao.statistics->error;
    object["statistics"] = statistics_json(*ao.statistics);
    object["max_error_at_px"] = place_json(error.max_x, error.max_y);
  }
  add_metrics(object, ao.metrics);
  if (ao.stages) {
    const AoStages& stages = *ao.stages;
    object["stages"] = {{"integral", stages.integral},
                        {"rays", stages.integrals.rays},
                        {"statistics", statistics_json(stages.statistics)}};
  }
  return object;
}

Json image_json(const SceneFacts& scene, const ImageMeasurement& image) {
  Json object;
  if (image.statistics) {
    object["statistics"] = statistics_json(*image.statistics);
    object["max_error_at_px"] = place_json(image.statistics->error.max_x, image.statistics->error.max_y);
  }
  add_metrics(object, image.metrics);
  if (!image.raster || image.raster->counters.empty()) return object;
  for (std::size_t i = 0; i < image.lights.size(); ++i) {
    const LightCounters& c = image.raster->counters[i];
    object["light_volumes"].push_back({{"light", scene.title(image.lights[i])},
                                       {"shaded_px", c.shaded},
                                       {"in_vain_px", c.in_vain},
                                       {"missed_px", c.missed}});
  }
  return object;
}

}  // namespace

Json to_json(const BiasInUnits& bias) {
  return {{"m", bias.metres}, {"texels", bias.texels}, {"normalised_depth", bias.depth}};  // null if not finite
}

nlohmann::ordered_json to_json(const std::vector<NamedLayer>& layers) {
  static constexpr std::array<const char*, 5> roles = {"reference", "technique", "error", "cause", "other"};
  static constexpr std::array<const char*, 6> kinds = {"share", "error", "number", "category", "color", "vector"};
  Json list = Json::array();
  for (const NamedLayer& layer : layers) {
    const LayerDescription& d = *layer.description;
    Json object = {{"name", layer_name(d.layer, layer.light)}, {"title", d.title}};
    if (!layer.light.empty()) object["light"] = layer.light;
    object["unit"] = d.unit;
    object["role"] = roles[static_cast<std::size_t>(d.role)];
    object["kind"] = kinds[static_cast<std::size_t>(d.kind)];
    if (d.kind == ViewerKind::share) object["range"] = {0.0, d.reach};
    if (d.kind == ViewerKind::error) object["range"] = {-d.reach, d.reach};
    list.push_back(std::move(object));
  }
  return list;
}

std::string to_summary_json(const RunResults& results, const std::optional<SweepSummary>& sweep,
                            const std::vector<std::string>& files, const std::vector<std::string>& problems) {
  Json summary = summary_head(results.command);
  summary["scene"] = {{"name", scene_title(results.experiment)},
                      {"triangles", results.scene.triangles},
                      {"instances", results.scene.instances},
                      {"materials", results.scene.materials}};
  summary["embree"] = results.embree;
  if (!results.opengl.empty()) summary["opengl"] = results.opengl;
  if (!results.engine.empty()) summary["engine"] = results.engine;
  summary["notes"] = results.notes;
  // Of a sweep: those of the cell that was measured, like all that follows.
  Experiment experiment = results.measurement ? results.measurement->experiment : results.experiment;
  Json parameters = Json::object();
  for (const Parameter& parameter : describe(experiment)) parameters[parameter.key] = to_json(parameter.value());
  summary["parameters"] = parameters;
  if (sweep) {
    Json cell = Json::object();
    for (const auto& [key, value] : sweep->least) cell[key] = to_json(value);
    summary["cell"] = cell;
  }
  if (const std::optional<Measurement>& measurement = results.measurement) {
    summary["camera"] = measurement->surfels.view.camera.name;
    summary["shadows"] = Json::array();
    for (const ShadowMeasurement& shadow : measurement->shadows) {
      summary["shadows"].push_back(shadow_json(results.scene, shadow));
    }
    if (measurement->ao) summary["ao"] = ao_json(*measurement->ao);
    if (measurement->image) summary["image"] = image_json(results.scene, *measurement->image);
  }
  if (sweep) {
    Json axes = Json::object();
    for (const auto& [key, text] : results.experiment.axes) axes[key] = text;
    summary["sweep"] = {{"axes", axes}, {"cells", sweep->cells}, {"least_mae", rows_json(results.sweep->best)}};
    summary["sweep"]["open_ends"] = to_json(sweep->open_ends);
    for (const ShadowMeasurement& shadow : results.measurement->shadows) {
      if (!shadow.advice || shadow.advice->engines.empty()) continue;
      summary["sweep"]["engines_at_least_mae"] = to_json(shadow.advice->engines);
    }
    if (results.sweep->curves) summary["curves"] = to_json(*results.sweep->curves);
  }
  if (results.tune) {
    summary["tuning"] = to_json(results.tune->summary);
    for (const CaseEngines& each : results.tune->engines) {
      summary["tuning"]["engines"].push_back({{"case", each.title}, {"engines", to_json(each.engines)}});
    }
  }
  if (results.measurement) summary["layers"] = to_json(named_layers(results.measurement->layers));
  summary["files"] = files;
  summary["problems"] = problems;
  return json_text(summary, 2) + "\n";
}

}  // namespace umbrameter
