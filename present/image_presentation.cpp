#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/metrics/color_space.h"
#include "present/presentation.h"
#include "present/presentation_parts.h"
#include "results/layer_description.h"

namespace umbrameter {
namespace {

ImageFigure picture_figure(const char* stem, const char* title, std::string caption, const Image<vec3>& image,
                           const Experiment& experiment) {
  ImageFigure figure;
  figure.stem = stem;
  figure.title = title;
  figure.caption = std::move(caption);
  figure.color = tone_map(image, static_cast<float>(experiment.shading.exposure));
  return figure;
}

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

void add_gbuffer_figures(Presentation& presentation, const SceneFacts& scene, const ImageMeasurement& image) {
  const auto scale = [](double reach, const char* quantity) {
    return ColorScale{ColorMap::error, -reach, reach, fmt::format("{}: with the G-buffer − exact", quantity)};
  };
  const ImageMeasurement::GBufferChange& change = *image.gbuffer_change;
  const std::string caption = path_text(image.experiment) + ".";
  add_figure(presentation, scalar_figure("gbuffer_change_image", "What the G-buffer changes: the image", caption,
                                         change.image, scale(0.25, "luminance [1 is white]")));
  add_figure(presentation, scalar_figure("gbuffer_change_ao", "What the G-buffer changes: ambient occlusion", caption,
                                         change.ao, scale(0.5, "accessibility")));
  for (std::size_t i = 0; i < image.lights.size(); ++i) {
    add_figure(presentation, scalar_figure("gbuffer_change_visibility_" + scene.layer(image.lights[i]),
                                           "What the G-buffer changes: visibility of " + scene.title(image.lights[i]),
                                           caption, change.visibility[i], scale(1.0, "visibility")));
  }
}

// Below a ten-thousandth of a per cent the two processors round differently.
std::string part_text(double part) { return std::abs(part) < 1e-6 ? "0 %" : percent(part); }

// A warning if the exposure makes most of the image too bright or too dark to see; otherwise empty.
std::string exposure_warning(const ImageMeasurement& image) {
  const Image<vec3>& colors = image.truth ? *image.truth : image.raster->radiance;
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

Presentation present_image(const SceneFacts& scene, const ImageMeasurement& image) {
  const Experiment& experiment = image.experiment;
  Presentation presentation;
  ReportSection& section = presentation.section;
  section.title = "The shaded image";
  if (image.truth) {
    add_figure(presentation, picture_figure("truth_image", "Reference: the image",
                                            "The same light model with traced visibility and ambient occlusion.",
                                            *image.truth, experiment));
  }
  if (image.raster) {
    add_figure(presentation, picture_figure("raster_image", "The technique's image", path_text(experiment) + ".",
                                            image.raster->radiance, experiment));
  }
  const std::string warning = exposure_warning(image);
  const bool has_volumes = image.raster && std::any_of(image.raster->counters.begin(), image.raster->counters.end(),
                                                       [](const LightCounters& c) { return c != LightCounters{}; });
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
  const float exposure = static_cast<float>(experiment.shading.exposure);
  add_figure(presentation,
             scalar_figure("error_image", "Error: the image", "Luminance, technique − reference.",
                           signed_error(luminance(image.raster->radiance, exposure), luminance(*image.truth, exposure)),
                           color_scale(Layer::error_image)));
  ImageFigure causes;
  causes.stem = "cause_image";
  causes.title = "Cause of the image's error";
  causes.caption =
      "The input that matters most: replacing it by the reference's changes the pixel most. Only where the error is "
      "visible.";
  causes.category = image.causes;
  causes.categories = image_cause_colors();
  add_figure(presentation, std::move(causes));
  if (image.gbuffer_change) add_gbuffer_figures(presentation, scene, image);
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
      "add up. An area "
      "light is shaded from its centre on both sides, and only its visibility is integrated.",
      path_text(experiment));
  section.tables.insert(section.tables.begin(), statistics_table("Error of the image", s));
  add_metrics_table(section, image.metrics);
  presentation.answers.push_back(fmt::format("image: error {} of white, {} away from shadow edges; by part: {}",
                                             percent(s.error.mae), percent(s.mae_off_edges), parts));
  if (!warning.empty()) {
    presentation.answers.push_back("warning: " + warning);
    section.text += "\n\nWarning: " + warning + ".";
  }
  return presentation;
}

}  // namespace umbrameter
