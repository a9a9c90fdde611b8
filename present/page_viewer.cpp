#include "present/page_viewer.h"

#include <fmt/format.h>

#include <limits>
#include <map>

#include "core/quantiles.h"
#include "present/error_backdrop.h"
#include "present/presentation.h"
#include "present/presentation_parts.h"
#include "results/layers.h"

namespace umbrameter {
namespace {

constexpr const char* ao_group = "ambient occlusion";
constexpr const char* image_group = "shaded image";
constexpr const char* scene_group = "scene";
constexpr const char* picture_name = "picture";

// Titles, colours and roles of the layers by name.
using LayerTable = std::map<std::string, ViewerLayer>;

void add_light(LayerTable& table, const std::string& light, const std::string& group) {
  using enum ViewerKind;
  const auto add = [&](const std::string& prefix, ViewerLayer layer) {
    layer.group = group;
    table[prefix + light] = std::move(layer);
  };
  add("truth_visibility_", {{}, "Reference", {}, ViewerRole::reference, share});
  add("raster_visibility_", {{}, "Technique", {}, ViewerRole::technique, share});
  add("error_visibility_", {{}, "Error", {}, ViewerRole::error, error, 1.0});
  add("class_", {{}, "Cause", {}, ViewerRole::cause, category, 1.0, "", class_colors()});
  add("truth_visibility_standard_error_", {{}, "Standard error of the reference"});
  add("truth_visibility_samples_", {{}, "Samples per pixel of the reference"});
  add("gbuffer_change_visibility_", {{}, "Change by the G-buffer", {}, ViewerRole::other, error, 1.0});
}

LayerTable layer_table(const SceneFacts& scene, const Measurement& measurement) {
  using enum ViewerKind;
  LayerTable table = {
      {"truth_ao", {{}, "Reference", ao_group, ViewerRole::reference, share}},
      {"raster_ao", {{}, "Technique", ao_group, ViewerRole::technique, share}},
      {"error_ao", {{}, "Error", ao_group, ViewerRole::error, error, 0.5}},
      {"truth_ao_standard_error", {{}, "Standard error of the reference", ao_group}},
      {"truth_ao_samples", {{}, "Rays per pixel of the reference", ao_group}},
      {"truth_ao_hit_distance", {{}, "Distance of occluders", ao_group, ViewerRole::other, number, 1.0, "m"}},
      {"truth_bent_normal", {{}, "Bent normal", ao_group, ViewerRole::other, vector}},
      {"gbuffer_change_ao", {{}, "Change by the G-buffer", ao_group, ViewerRole::other, error, 0.5}},
      {"truth_image", {{}, "Reference", image_group, ViewerRole::reference, color}},
      {"raster_image", {{}, "Technique", image_group, ViewerRole::technique, color}},
      {"error_image", {{}, "Error of luminance", image_group, ViewerRole::error, error, 0.25}},
      {"cause_image", {{}, "Cause", image_group, ViewerRole::cause, category, 1.0, "", image_cause_colors()}},
      {"truth_image_standard_error", {{}, "Standard error of the reference", image_group}},
      {"raster_light_buffer", {{}, "Light buffer", image_group, ViewerRole::other, color}},
      {"gbuffer_change_image", {{}, "Change by the G-buffer", image_group, ViewerRole::other, error, 0.25}},
      {"", {{}, "Picture", scene_group, ViewerRole::other, color}},
      {"Z", {{}, "Depth", scene_group, ViewerRole::other, number, 1.0, "m"}},
      {"gbuffer_normal", {{}, "Geometric normal", scene_group, ViewerRole::other, vector}},
  };
  for (const ShadowMeasurement& shadow : measurement.shadows) {
    add_light(table, scene.layer(shadow.light), scene.title(shadow.light));
    if (shadow.truth && shadow.is_sampled) {
      table["truth_visibility_standard_error_" + scene.layer(shadow.light)].reach =
          student_95(shadow.truth->degrees_of_freedom);
    }
  }
  if (measurement.ao && measurement.ao->truth) {
    table["truth_ao_standard_error"].reach = student_95(measurement.ao->truth->degrees_of_freedom);
  }
  return table;
}

// Positions and variances are incompressible and of no use to the eye.
bool is_for_programs(const std::string& name) {
  return name == "gbuffer_position" || name == "truth_ao_variance" || name.starts_with("truth_visibility_variance_") ||
         name.starts_with("counted_");
}

// A layer that the table does not list is shown as a number.
ViewerLayer start_layer(const LayerTable& table, const std::string& name) {
  const auto found = table.find(name);
  ViewerLayer layer = found != table.end() ? found->second : ViewerLayer{{}, name, "further layers"};
  layer.name = name.empty() ? picture_name : name;
  return layer;
}

std::vector<ViewerLayer> viewer_layers(const LayerTable& table, const LayeredImage& image) {
  std::vector<ViewerLayer> layers;
  for (const Channel& channel : image.channels) {
    const std::size_t dot = channel.name.rfind('.');
    const std::string component = dot == std::string::npos ? channel.name : channel.name.substr(dot + 1);
    if (component == "A") continue;
    const std::string name = dot != std::string::npos ? channel.name.substr(0, dot) : component == "Z" ? "Z" : "";
    if (is_for_programs(name)) continue;
    const ViewerLayer layer = start_layer(table, name);
    if (layers.empty() || layers.back().name != layer.name) layers.push_back(layer);
    layers.back().planes.push_back(channel.values);
    hide_uncounted(layers.back().planes.back(), name, image);
  }
  return layers;
}

// Why the images of a light cannot follow a change of the bias.
std::string missing_text(const ShadowMeasurement& shadow) {
  if (const std::string reason = nothing_counted_text(shadow.counted); !reason.empty()) {
    return "There is no bias slider: " + reason + ".";
  }
  if (shadow.is_sampled) {
    return shadow.experiment.truth.shadow == ShadowReference::pixel
               ? "The reference is a mean over each pixel, so that no single tap is right or wrong; there is no bias "
                 "slider."
               : "An area light has a soft shadow, so that no single tap is right or wrong; there is no bias slider.";
  }
  const TechniqueCapabilities can = capabilities_of(make_technique(shadow.experiment.shadow));
  if (!can.sums_comparisons) {
    return "This technique does not sum depth comparisons, so that taps have no critical bias; there is no bias "
           "slider.";
  }
  if (!can.taps_independent_of_bias) {
    return "The bias of this technique changes which texels it compares, so that one pass does not give the images at "
           "other biases; there is no bias slider.";
  }
  return fmt::format("The bias slider needs one depth comparison per pixel (shadow.filter nearest); this run uses {}.",
                     value_text(shadow.experiment, "shadow.filter"));
}

ViewerBias viewer_bias(const SceneFacts& scene, const ShadowMeasurement& shadow) {
  ViewerBias bias;
  bias.group = scene.title(shadow.light);
  if (!shadow.advice || !shadow.advice->flips) bias.missing = missing_text(shadow);
  if (!shadow.advice) return bias;
  const BiasAdvice& advice = *shadow.advice;
  bias.mean_texel = advice.mean_texel;
  if (advice.unit == LengthUnit::texels) {
    bias.unit = "texels";
    bias.unit_length = advice.mean_texel;
  } else if (advice.unit == LengthUnit::map_depth) {
    bias.unit = "depth";
    bias.unit_length = advice.depth_unit;
  }
  bias.used = advice.used.constant;
  for (const BiasCell& cell : advice.cells) {
    bias.axis.push_back(cell.constant);
    bias.shares.push_back({cell.acne, cell.false_occlusion, cell.peter_panning, cell.leak});
  }
  if (!advice.flips) return bias;
  bias.bin = advice.flips->bin;
  bias.cause = Image<std::uint8_t>(bias.bin.width, bias.bin.height);
  for (std::size_t i = 0; i < bias.bin.size(); ++i) {
    if (bias.bin[i] == 0) continue;
    bias.cause[i] = static_cast<std::uint8_t>(static_cast<std::size_t>(PixelClass::acne) +
                                              static_cast<std::size_t>(advice.flips->cause[i]));
  }
  return bias;
}

// The parts in view, in the scene's order; none if there are more than 16 bits can number.
ViewerParts viewer_parts(const SceneParts& scene, const GBuffer& gbuffer) {
  std::map<std::uint32_t, std::uint16_t> numbers;
  for (const std::uint32_t instance : gbuffer.instance.pixels) {
    if (instance != no_id) numbers.emplace(scene.of_instance[instance], 0);
  }
  if (numbers.size() >= std::numeric_limits<std::uint16_t>::max()) return {};
  ViewerParts parts{Image<std::uint16_t>(gbuffer.width, gbuffer.height), {}};
  for (auto& [part, number] : numbers) {
    parts.names.push_back(scene.names[part]);
    number = static_cast<std::uint16_t>(parts.names.size());
  }
  for (std::size_t i = 0; i < gbuffer.instance.size(); ++i) {
    if (gbuffer.is_surface(i)) parts.index[i] = numbers[scene.of_instance[gbuffer.instance[i]]];
  }
  return parts;
}

}  // namespace

ViewerData viewer_data(const SceneFacts& scene, const Measurement& measurement, const LayeredImage& image,
                       bool is_full) {
  const GBuffer& gbuffer = measurement.surfels.gbuffer;
  ViewerData data;
  data.width = gbuffer.width;
  data.height = gbuffer.height;
  data.full = is_full;
  data.layers = viewer_layers(layer_table(scene, measurement), image);
  for (const ShadowMeasurement& shadow : measurement.shadows) {
    if (shadow.raster && shadow.truth) data.biases.push_back(viewer_bias(scene, shadow));
  }
  data.objects = viewer_parts(scene.by_object, gbuffer);
  data.materials = viewer_parts(scene.by_material, gbuffer);
  return data;
}

ViewerData further_viewer_data(const SceneFacts& scene, const Measurement& measurement, bool is_full) {
  ViewerData data = viewer_data(scene, measurement, layers_of(scene, measurement), is_full);
  data.rounded = true;
  std::erase_if(data.layers, [](const ViewerLayer& layer) { return layer.name == picture_name; });
  return data;
}

}  // namespace umbrameter
