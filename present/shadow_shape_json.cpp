#include <nlohmann/json.hpp>
#include <optional>

#include "present/presentation_parts.h"
#include "reports/files/value_json.h"

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

Json caster_json(const SceneFacts& scene, const CasterShape& caster) {
  Json object = {{"object", scene.by_object.names[caster.object]}, {"index", caster.object}};
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

// "views", "seams" and "fit_shimmer" where they apply.
void add_map_views(Json& object, const MapViews& views) {
  for (const ViewStatistics& view : views.views) object["views"].push_back(statistics_json(view));
  if (views.seams) object["seams"] = statistics_json(*views.seams);
  if (views.shimmer) object["fit_shimmer"] = statistics_json(*views.shimmer);
}

}  // namespace

nlohmann::ordered_json to_json(const SceneFacts& scene, const ShadowShape& shape) {
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
  for (const CasterShape& caster : shape.casters) object["casters"].push_back(caster_json(scene, caster));
  return object;
}

}  // namespace umbrameter
