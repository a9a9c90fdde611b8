#include "results/layer_description.h"

#include <cassert>

namespace umbrameter {
namespace {

constexpr std::string_view visibility_label = "visibility: 0 blocked, 1 lit";
constexpr std::string_view accessibility_label = "accessibility: 0 closed, 1 open";
constexpr std::string_view error_label = "technique − reference: below 0 is too dark";
constexpr std::string_view luminance_label = "technique − reference [luminance, 1 is white]: below 0 is too dark";
constexpr std::string_view stage_label = "change of accessibility: below 0 darkens";
constexpr bool for_programs = true;

std::vector<LayerDescription> make_descriptions() {
  using enum LayerSubject;
  using enum ViewerRole;
  constexpr auto share = ViewerKind::share;
  constexpr auto number = ViewerKind::number;
  constexpr auto category = ViewerKind::category;
  constexpr auto color = ViewerKind::color;
  constexpr auto vector = ViewerKind::vector;
  constexpr auto change = ViewerKind::error;
  using L = Layer;
  return {
      {L::truth_visibility, "truth_visibility", light, "Reference", "1", reference, share, 1.0, visibility_label},
      {L::truth_visibility_standard_error, "truth_visibility_standard_error", light, "Standard error of the reference",
       "1"},
      {L::truth_visibility_variance, "truth_visibility_variance", light, "Variance of the reference", "1", other,
       number, 1.0, "", for_programs},
      {L::truth_visibility_samples, "truth_visibility_samples", light, "Samples per pixel of the reference", "1"},
      {L::raster_visibility, "raster_visibility", light, "Technique", "1", technique, share, 1.0, visibility_label},
      {L::error_visibility, "error_visibility", light, "Error", "1", error, change, 1.0, error_label},
      {L::counted, "counted", light, "Counted pixels", "", other, number, 1.0, "", for_programs},
      {L::classes, "class", light, "Cause", "", cause, category},
      {L::acne, "acne", light, "Wrong by acne", "1", other, share},
      {L::false_occlusion, "false_occlusion", light, "Wrong by false occlusion", "1", other, share},
      {L::peter_panning, "peter_panning", light, "Wrong by peter-panning", "1", other, share},
      {L::leak, "leak", light, "Wrong by a light leak", "1", other, share},
      {L::truth_ao, "truth_ao", ao, "Reference", "1", reference, share, 1.0, accessibility_label},
      {L::truth_ao_standard_error, "truth_ao_standard_error", ao, "Standard error of the reference", "1"},
      {L::truth_ao_variance, "truth_ao_variance", ao, "Variance of the reference", "1", other, number, 1.0, "",
       for_programs},
      {L::truth_ao_samples, "truth_ao_samples", ao, "Samples per pixel of the reference", "1"},
      {L::truth_bent_normal, "truth_bent_normal", ao, "Bent normal", "", other, vector},
      {L::truth_ao_hit_distance, "truth_ao_hit_distance", ao, "Distance of occluders", "m", other, number},
      {L::raster_ao, "raster_ao", ao, "Technique", "1", technique, share, 1.0, accessibility_label},
      {L::error_ao, "error_ao", ao, "Error", "1", error, change, 0.5, error_label},
      {L::ao_stage_model, "ao_stage_model", ao, "Stage: model", "1", other, change, 0.25, stage_label},
      {L::ao_stage_off_screen, "ao_stage_off_screen", ao, "Stage: off-screen", "1", other, change, 0.25, stage_label},
      {L::ao_stage_hidden, "ao_stage_hidden", ao, "Stage: hidden", "1", other, change, 0.25, stage_label},
      {L::ao_stage_thin, "ao_stage_thin", ao, "Stage: thin", "1", other, change, 0.25, stage_label},
      {L::ao_stage_approximation, "ao_stage_approximation", ao, "Stage: approximation", "1", other, change, 0.25,
       stage_label},
      {L::ao_stage_sampling, "ao_stage_sampling", ao, "Stage: sampling", "1", other, change, 0.25, stage_label},
      {L::ao_stage_blur, "ao_stage_blur", ao, "Stage: blur", "1", other, change, 0.25, stage_label},
      {L::truth_image, "truth_image", image, "Reference", "1", reference, color},
      {L::truth_image_standard_error, "truth_image_standard_error", image, "Standard error of the reference", "1"},
      {L::raster_image, "raster_image", image, "Technique", "1", technique, color},
      {L::raster_light_buffer, "raster_light_buffer", image, "Light buffer", "1", other, color},
      {L::error_image, "error_image", image, "Error of luminance", "1", error, change, 0.25, luminance_label},
      {L::cause_image, "cause_image", image, "Cause", "", cause, category},
      {L::gbuffer_change_visibility, "gbuffer_change_visibility", light, "Change by the G-buffer", "1", other, change,
       1.0, "visibility: with the G-buffer − exact"},
      {L::gbuffer_change_ao, "gbuffer_change_ao", ao, "Change by the G-buffer", "1", other, change, 0.5,
       "accessibility: with the G-buffer − exact"},
      {L::gbuffer_change_image, "gbuffer_change_image", image, "Change by the G-buffer", "1", other, change, 0.25,
       "luminance [1 is white]: with the G-buffer − exact"},
      {L::gbuffer_position, "gbuffer_position", scene, "Position", "m", other, vector, 1.0, "", for_programs},
      {L::gbuffer_normal, "gbuffer_normal", scene, "Geometric normal", "", other, vector},
      {L::picture, "", scene, "Picture", "1", other, color},
      {L::depth, "Z", scene, "Depth", "m", other, number},
  };
}

}  // namespace

const std::vector<LayerDescription>& layer_descriptions() {
  static const std::vector<LayerDescription> descriptions = make_descriptions();
  return descriptions;
}

const LayerDescription& describe(Layer layer) {
  const LayerDescription& description = layer_descriptions()[static_cast<std::size_t>(layer)];
  assert(description.layer == layer);
  return description;
}

std::string layer_name(Layer layer, std::string_view light) {
  std::string name(describe(layer).name);
  if (!light.empty()) name.append("_").append(light);
  return name;
}

std::optional<NamedLayer> find_layer(std::string_view name) {
  std::optional<NamedLayer> found;
  for (const LayerDescription& each : layer_descriptions()) {
    if (each.subject != LayerSubject::light) {
      if (each.name == name) return NamedLayer{&each};
      continue;
    }
    const bool fits =
        name.size() > each.name.size() + 1 && name.starts_with(each.name) && name[each.name.size()] == '_';
    // The longest name decides: "truth_visibility_variance_sun" is no layer of a light "variance_sun".
    if (!fits || (found && found->description->name.size() > each.name.size())) continue;
    found = NamedLayer{&each, std::string(name.substr(each.name.size() + 1))};
  }
  return found;
}

ColorScale color_scale(Layer layer) {
  const LayerDescription& description = describe(layer);
  const bool is_error = description.kind == ViewerKind::error;
  return {is_error ? ColorMap::error : ColorMap::visibility, is_error ? -description.reach : 0.0, description.reach,
          std::string(description.scale_label)};
}

}  // namespace umbrameter
