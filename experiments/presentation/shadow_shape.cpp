#include "experiments/presentation/shadow_shape.h"

#include <fmt/format.h>

#include <utility>

#include "experiments/measure.h"
#include "experiments/presentation/map_views_report.h"
#include "raytrace/casters.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

Json spread_json(const std::optional<Spread>& spread) {
  if (!spread) return nullptr;
  return {{"median", spread->median}, {"upper_95", spread->upper}, {"largest", spread->largest}};
}

Json distances_json(const EdgeDistances& distances) {
  Json within = Json::array();
  for (std::size_t k = 0; k < edge_reaches.size(); ++k) {
    within.push_back({{"texels", edge_reaches[k]}, {"share", distances.within[k]}});
  }
  return {{"weight_px", distances.weight},
          {"px", spread_json(distances.pixels)},
          {"texels", spread_json(distances.texels)},
          {"m", spread_json(distances.metres)},
          {"within_1_texel", distances.within[one_texel]},
          {"within_2_texels", distances.within[two_texels]},
          {"within", within}};
}

Json components_json(const ComponentStatistics& s) {
  Json object = {{"count", s.count},
                 {"mean_area_px", s.mean_area},
                 {"largest_area_px", s.largest_area},
                 {"largest_share", s.largest_share}};
  object["largest_at_px"] = s.count == 0 ? Json(nullptr) : Json{s.largest_x, s.largest_y};
  return object;
}

Json length_json(const ReceiverLength& length) {
  return {{"m", length.metres}, {"texels", length.texels}, {"px", length.pixels}};
}

Json caster_json(const Stages& stages, const CasterShape& caster) {
  Json object = {{"object", stages.scene().objects[caster.object].name}, {"index", caster.object}};
  object["contact_gap"] = {{"contacts_px", caster.contacts}, {"lost_px", caster.lost}};
  if (caster.contacts > 0) {
    object["contact_gap"]["median"] = length_json(caster.gap_median);
    object["contact_gap"]["largest"] = length_json(caster.gap_largest);
  }
  object["inset"] = {{"edges_px", caster.edges}, {"unmatched_px", caster.unmatched}};
  if (caster.edges > 0) object["inset"]["median"] = length_json(caster.inset_median);
  return object;
}

Json search_json(const ContactSearch& search) {
  Json object = {{"shadowed_px", search.shadowed}, {"own_object_px", search.own_object},
                 {"head_on_px", search.head_on},   {"distant_px", search.distant},
                 {"hidden_px", search.hidden},     {"measured_px", search.measured}};
  const std::string missing = missing_contacts_text(search);
  object["not_measured_because"] = missing.empty() ? Json(nullptr) : Json(missing);
  return object;
}

Json shimmer_json(const Shimmer& shimmer) {
  Json camera = {{"pixels", shimmer.camera.pixels}, {"raster", shimmer.camera.share}};
  if (shimmer.camera_truth) camera["truth"] = shimmer.camera_truth->share;
  return {{"grid", {{"mean", shimmer.grid_mean}, {"largest", shimmer.grid_largest}}}, {"camera", camera}};
}

}  // namespace

ShadowShape measure_shape(Stages& stages, const ShadowMeasurement& shadow) {
  const Experiment& experiment = shadow.experiment;
  const Surfels& surfels = stages.surfels(experiment);
  const Light light = stages.light(experiment, shadow.light);
  const ShapeInput input{surfels.gbuffer,
                         shadow.truth->visibility,
                         shadow.counted,
                         light,
                         shadow.layout,
                         &shadow.truth->variance,
                         shadow.is_sampled ? &stages.hard_truth(experiment, shadow.light).visibility : nullptr};
  const VisibilityStatistics* causes = by_cause(shadow);
  if (causes == nullptr) {
    ShadowShape shape{analyze_error_shape(input, shadow.raster->visibility)};
    if (!shadow.is_sampled) shape.error.outside_penumbra.reset();
    shape.views = measure_map_views(stages, shadow);
    return shape;
  }
  const TracedCasters traced = trace_casters(stages.tracer(), surfels.gbuffer, light);
  const RasterVisibility& raster = *shadow.raster;
  CasterShapes casters = analyze_casters(
      {input, raster.visibility, raster.wrong, traced.instance, traced.distance, stages.scene(), surfels.view});
  const std::string missing = missing_contacts_text(casters.search);
  if (!missing.empty() && causes->peter_panning > 0.0) {
    stages.add_notes({stages.title(shadow.light) + ": " + missing});
  }
  return {analyze_error_shape(input, raster.wrong), std::move(casters.casters), casters.search, std::nullopt,
          measure_map_views(stages, shadow)};
}

std::string missing_contacts_text(const ContactSearch& search) {
  if (search.shadowed == 0 || search.measured > 0) return {};
  std::string text =
      fmt::format("no contact gap could be measured: of {} pixels in the reference shadow", search.shadowed);
  const char* separator = ", ";
  const auto add = [&](std::uint64_t pixels, const char* reason) {
    if (pixels == 0) return;
    text += fmt::format("{}{} {}", separator, pixels, reason);
    separator = "; ";
  };
  add(search.own_object, "are shadowed by the object that they belong to");
  add(search.head_on, "face the light head-on");
  add(search.distant, "are farther than one texel and 1.5 pixels from their caster");
  add(search.hidden, "touch their caster, but the receiver is hidden, bends or leaves the image before the gap ends");
  return text;
}

nlohmann::ordered_json to_json(const Stages& stages, const ShadowShape& shape) {
  Json object = {{"reference_edges_px", shape.error.edges}};
  object["edge_distance"] = {{"all", distances_json(shape.error.all)}};
  if (shape.shimmer) object["shimmer"] = shimmer_json(*shape.shimmer);
  add_map_views(object, shape.views);
  const bool is_hard = shape.error.components.has_value();
  for (std::size_t p = 0; p < shape.error.parts.size(); ++p) {
    const std::string_view name = is_hard ? cause_names[p] : soft_part_names[p];
    object["edge_distance"][std::string(name)] = distances_json(shape.error.parts[p]);
  }
  if (!is_hard) {
    if (shape.error.outside_penumbra) object["outside_penumbra"] = *shape.error.outside_penumbra;
    return object;
  }
  object["components"] = {{"all", components_json(*shape.error.components)}};
  for (std::size_t c = 0; c < cause_count; ++c) {
    object["components"][std::string(cause_names[c])] = components_json(shape.error.class_components[c]);
  }
  if (shape.contact_search) object["contact_search"] = search_json(*shape.contact_search);
  object["casters"] = Json::array();
  for (const CasterShape& caster : shape.casters) object["casters"].push_back(caster_json(stages, caster));
  return object;
}

}  // namespace umbrameter
