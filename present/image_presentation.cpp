#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/metrics/color_space.h"
#include "present/presentation.h"
#include "present/presentation_parts.h"
#include "results/layers.h"

namespace umbrameter {
namespace {

std::string path_text(const Experiment& experiment) {
  if (experiment.shading.path == ShadingPath::forward) return "Forward shading";
  return fmt::format("Deferred shading; normals {}, depth {}, colours {}, positions from {}",
                     value_text(experiment, "shading.normal-format"), value_text(experiment, "shading.depth-format"),
                     value_text(experiment, "shading.color-format"),
                     experiment.shading.position == PositionSource::depth ? "depth" : "a stored buffer");
}

ReportTable counters_table(const SceneFacts& scene, const ImageMeasurement& image) {
  Table table{{{"light", "", ""},
               {"fragments", "px", "fragments of the light's volume that were shaded"},
               {"in vain", "px", "of these, outside the light's exact sphere or cone, or on the background"},
               {"missed", "px", "pixels inside of it that were not shaded"}},
              {}};
  for (std::size_t i = 0; i < image.lights.size(); ++i) {
    const LightCounters& c = image.raster->counters[i];
    if (c == LightCounters{}) continue;
    table.rows.push_back({scene.title(image.lights[i]), static_cast<std::int64_t>(c.shaded),
                          static_cast<std::int64_t>(c.in_vain), static_cast<std::int64_t>(c.missed)});
  }
  return {fmt::format("Light volumes, {} faces drawn", value_text(image.experiment, "shading.volume-faces")),
          std::move(table)};
}

void add_gbuffer_figures(Presentation& presentation, const SceneFacts& scene, const LayeredImage& layers,
                         const ImageMeasurement& image) {
  const std::string caption = path_text(image.experiment) + ".";
  add_layer_figure(presentation, layers, Layer::gbuffer_change_image, {}, "What the G-buffer changes: the image",
                   caption);
  add_layer_figure(presentation, layers, Layer::gbuffer_change_ao, {}, "What the G-buffer changes: ambient occlusion",
                   caption);
  for (const std::uint32_t light : image.lights) {
    add_layer_figure(presentation, layers, Layer::gbuffer_change_visibility, scene.layer(light),
                     "What the G-buffer changes: visibility of " + scene.title(light), caption);
  }
}

// Below a ten-thousandth of a per cent the two processors round differently.
std::string part_text(double part) { return std::abs(part) < 1e-6 ? "0 %" : percent(part); }

// A warning if the exposure makes most of the image too bright or too dark to see; otherwise empty.
std::string exposure_warning(const LayeredImage& layers, const ImageMeasurement& image) {
  const Image<vec3> colors = colors_of(layers, image.truth ? Layer::truth_image : Layer::raster_image);
  const auto exposure = static_cast<float>(image.experiment.shading.exposure);
  std::vector<float> values;
  for (const vec3& color : colors.pixels) {
    if (const double value = luminance(color); value > 0.0) values.push_back(static_cast<float>(value));
  }
  if (values.empty()) return "the image is black: no light reaches what the camera sees";
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  const float bright = *at * exposure;
  if (bright <= 2.0f && bright >= 0.05f) return {};
  return fmt::format(
      "the image is too {} to see: nine tenths of it are below {:.2g}, where 1 is white; "
      "--shading.exposure {:.2g} makes that 0.8",
      bright > 1.0f ? "bright" : "dark", bright, 0.8f / *at);
}

}  // namespace

// The palette of class_colors(); "no visible error" is light.
std::vector<CategoryColor> image_cause_colors() {
  constexpr std::array<glm::u8vec3, image_cause_count> inks = {
      {{213, 94, 0}, {0, 114, 178}, {204, 121, 167}, {86, 180, 233}}};
  constexpr std::array<Hatch, image_cause_count> hatches = {Hatch::none, Hatch::horizontal, Hatch::rising, Hatch::dots};
  std::vector<CategoryColor> colors;
  for (std::size_t c = 0; c < image_cause_count; ++c) {
    colors.push_back({std::string(image_cause_names[c]), inks[c], hatches[c]});
  }
  colors.push_back({"no visible error, or background", {240, 240, 240}});
  return colors;
}

Presentation present_image(const SceneFacts& scene, const LayeredImage& layers, const ImageMeasurement& image) {
  const Experiment& experiment = image.experiment;
  Presentation presentation;
  ReportSection& section = presentation.section;
  section.title = "The shaded image";
  const double exposure = experiment.shading.exposure;
  add_layer_figure(presentation, layers, Layer::truth_image, {}, "Reference: the image",
                   "The same light model with traced visibility and ambient occlusion.", exposure);
  add_layer_figure(presentation, layers, Layer::raster_image, {}, "The technique's image", path_text(experiment) + ".",
                   exposure);
  const std::string warning = exposure_warning(layers, image);
  const bool has_volumes = image.raster && std::ranges::any_of(image.raster->counters, [](const LightCounters& c) {
                             return c != LightCounters{};
                           });
  if (has_volumes) section.tables.push_back(counters_table(scene, image));
  if (!image.statistics) {
    presentation.answers.push_back(fmt::format("image: {} light{}, {}", image.lights.size(),
                                               image.lights.size() == 1 ? "" : "s",
                                               image.raster ? path_text(experiment) : std::string("traced")));
    if (!warning.empty()) presentation.answers.push_back("warning: " + warning);
    return presentation;
  }
  const ImageStatistics& s = *image.statistics;
  if (s.error.pixels == 0) {
    presentation.answers.emplace_back("image: nothing to measure: all pixels are background");
    section.text = "Nothing to measure: all pixels are background.";
    return presentation;
  }
  add_layer_figure(presentation, layers, Layer::error_image, {}, "Error: the image", image_error_caption);
  add_layer_figure(presentation, layers, Layer::cause_image, {}, "Cause of the image's error", image_cause_caption);
  if (image.gbuffer_change) add_gbuffer_figures(presentation, scene, layers, image);
  section.headlines = {{"mean absolute error", percent(s.error.mae), "of white"},
                       {"away from shadow edges", percent(s.mae_off_edges), "farther than 3 px from an edge"}};
  std::string parts;
  for (std::size_t c = 0; c < image_cause_count; ++c) {
    section.headlines.push_back({std::string(image_cause_names[c]), part_text(s.parts[c]), "part of the error"});
    parts += fmt::format("{}{} {}", c > 0 ? ", " : "", image_cause_names[c], part_text(s.parts[c]));
  }
  section.text += fmt::format(
      "{}. Errors are of linear luminance times shading.exposure, in per cent of white. A part is how much the "
      "error falls when the reference's input replaces the technique's; parts can overlap or cancel, so they need not "
      "add up. In both images "
      "an area light is shaded from its centre, and only its visibility is integrated.",
      path_text(experiment));
  section.tables.insert(section.tables.begin(), statistics_table("Error of the image", s));
  add_metrics_table(section, image.metrics);
  presentation.answers.push_back(
      fmt::format("image: error {} of white, {} over the pixels away from shadow edges; with one "
                  "input of the reference in place of the technique's it falls by, in per cent of white: {} (parts may "
                  "overlap)",
                  percent(s.error.mae), percent(s.mae_off_edges), parts));
  if (!warning.empty()) {
    presentation.answers.push_back("warning: " + warning);
    section.text += "\n\nWarning: " + warning + ".";
  }
  return presentation;
}

}  // namespace umbrameter
