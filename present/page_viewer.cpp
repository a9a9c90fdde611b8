#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "core/quantiles.h"
#include "present/presentation_parts.h"
#include "results/layer_description.h"

namespace umbrameter {
namespace {

constexpr const char* picture_name = "picture";

std::string group_of(const NamedLayer& layer, const SceneFacts& scene) {
  switch (layer.description->subject) {
    case LayerSubject::light: {
      const auto found = std::ranges::find(scene.layers, layer.light);
      return found != scene.layers.end() ? scene.title(static_cast<std::uint32_t>(found - scene.layers.begin()))
                                         : layer.light;
    }
    case LayerSubject::ao:
      return "ambient occlusion";
    case LayerSubject::image:
      return "shaded image";
    case LayerSubject::scene:
      break;
  }
  return "scene";
}

// What makes a standard error the half width of a 95 % interval.
double half_width_of_standard_error(Layer layer, const std::string& light, const SceneFacts& scene,
                                    const Measurement& measurement) {
  if (layer == Layer::truth_ao_standard_error) return student_95(measurement.ao->truth->degrees_of_freedom);
  for (const ShadowMeasurement& shadow : measurement.shadows) {
    if (layer == Layer::truth_visibility_standard_error && scene.layer(shadow.light) == light) {
      return student_95(shadow.truth->degrees_of_freedom);
    }
  }
  return 1.0;
}

// Nothing for a layer that the viewer leaves out.
std::optional<ViewerLayer> start_layer(const std::string& name, const SceneFacts& scene,
                                       const Measurement& measurement) {
  const std::optional<NamedLayer> layer = find_layer(name);
  if (!layer || layer->description->is_for_programs) return std::nullopt;
  const LayerDescription& d = *layer->description;
  const std::string unit(d.unit == "1" ? "" : d.unit);
  ViewerLayer started{
      name.empty() ? picture_name : name, std::string(d.title), group_of(*layer, scene), d.role, d.kind, d.reach, unit};
  started.categories = categories_of(d.layer);
  if (d.role == ViewerRole::other && d.kind == ViewerKind::number) {
    started.reach = half_width_of_standard_error(d.layer, layer->light, scene, measurement);
  }
  return started;
}

std::vector<ViewerLayer> viewer_layers(const SceneFacts& scene, const Measurement& measurement) {
  std::vector<ViewerLayer> layers;
  for (const Channel& channel : measurement.layers.channels) {
    const std::size_t dot = channel.name.rfind('.');
    const std::string component = dot == std::string::npos ? channel.name : channel.name.substr(dot + 1);
    if (component == "A") continue;
    const std::string name = dot != std::string::npos ? channel.name.substr(0, dot) : component == "Z" ? "Z" : "";
    const std::optional<ViewerLayer> layer = start_layer(name, scene, measurement);
    if (!layer) continue;
    if (layers.empty() || layers.back().name != layer->name) layers.push_back(*layer);
    layers.back().planes.push_back(channel.values);
    hide_uncounted(layers.back().planes.back(), name, measurement.layers);
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
  if (const std::string renderer = renderer_title(shadow.experiment); !renderer.empty()) {
    return fmt::format("There is no bias slider: only an image is known ({}), not its taps.", renderer);
  }
  const TechniqueCapabilities can = capabilities_of(make_technique(shadow.experiment.shadow));
  if (!can.sums_comparisons) {
    return fmt::format(
        "The result of {} is no sum of depth comparisons, so that taps have no critical bias; there is no bias slider.",
        technique_name(shadow.experiment));
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
  bias.texels_differ = advice.texels_differ;
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

ViewerData viewer_data(const SceneFacts& scene, const Measurement& measurement, bool is_full) {
  const GBuffer& gbuffer = measurement.surfels.gbuffer;
  ViewerData data;
  data.width = gbuffer.width;
  data.height = gbuffer.height;
  data.full = is_full;
  data.layers = viewer_layers(scene, measurement);
  for (const ShadowMeasurement& shadow : measurement.shadows) {
    if (shadow.raster && shadow.truth) data.biases.push_back(viewer_bias(scene, shadow));
  }
  data.objects = viewer_parts(scene.by_object, gbuffer);
  data.materials = viewer_parts(scene.by_material, gbuffer);
  return data;
}

void add_cell_images(ViewerPack& pack, const SceneFacts& scene, const Measurement& measurement, const ViewerCell& cell,
                     bool is_full) {
  ViewerData data = viewer_data(scene, measurement, is_full);
  data.cell = cell;
  if (!pack.sets.empty()) {
    data.rounded = true;
    std::erase_if(data.layers, [](const ViewerLayer& layer) { return layer.name == picture_name; });
  }
  add_set(pack, data);
}

}  // namespace umbrameter
