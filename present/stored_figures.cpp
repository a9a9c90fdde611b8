#include "present/stored_figures.h"

#include <algorithm>
#include <cmath>

#include "present/ao_stages_report.h"
#include "present/error_backdrop.h"
#include "present/image_scales.h"
#include "present/presentation.h"

namespace umbrameter {
namespace {

constexpr const char* error_caption = "Technique − reference: blue is too dark, red is too bright.";

void add_scalar(std::vector<ImageFigure>& figures, const StoredRun& run, const std::string& layer,
                const std::string& title, const std::string& caption, const ColorScale& scale) {
  const Image<float>* values = find_channel(run, layer + ".Y");
  if (values == nullptr) return;
  ImageFigure& figure = figures.emplace_back();
  figure.stem = layer;
  figure.title = title;
  figure.caption = caption;
  figure.values = *values;
  hide_uncounted(figure.values, layer, *run.images);
  figure.scale = scale;
}

void add_classes(std::vector<ImageFigure>& figures, const StoredRun& run, const std::string& layer,
                 const std::string& title, const std::string& caption, const std::vector<CategoryColor>& categories) {
  const Image<float>* numbers = find_channel(run, layer + ".Y");
  if (numbers == nullptr) return;
  ImageFigure& figure = figures.emplace_back();
  figure.stem = layer;
  figure.title = title;
  figure.caption = caption;
  figure.category = Image<std::uint8_t>(numbers->width, numbers->height);
  for (std::size_t i = 0; i < numbers->size(); ++i) {
    figure.category[i] = static_cast<std::uint8_t>(std::clamp((*numbers)[i], 0.0f, 255.0f));
  }
  figure.categories = categories;
}

}  // namespace

Figures stored_figures(const StoredRun& run) {
  Figures all;
  std::vector<ImageFigure>& figures = all.images;
  for (const auto& [light, layer] : run.layers) {
    add_scalar(figures, run, "truth_visibility_" + layer, "Reference: " + light, "Visibility of the reference.",
               visibility_scale);
    add_scalar(figures, run, "raster_visibility_" + layer, "Shadow map: " + light, "Visibility of the technique.",
               visibility_scale);
    add_scalar(figures, run, "error_visibility_" + layer, "Error: " + light, error_caption, visibility_error_scale);
    add_classes(figures, run, "class_" + layer, "Causes: " + light, "Main cause of the wrong taps of each pixel.",
                class_colors());
  }
  add_scalar(figures, run, "truth_ao", "Reference: ambient occlusion", "Accessibility of the reference.", ao_scale);
  add_scalar(figures, run, "raster_ao", "Ambient occlusion", "Accessibility of the technique.", ao_scale);
  add_scalar(figures, run, "error_ao", "Error: ambient occlusion", error_caption, ao_error_scale);
  add_scalar(figures, run, "error_image", "Error: the image", "Luminance, technique − reference.", image_error_scale);
  add_classes(figures, run, "cause_image", "Cause of the image's error",
              "The input whose replacement by the reference's changes the pixel most, where the error is visible.",
              image_cause_colors());
  for (std::size_t k = 0; k < ao_stage_count; ++k) {
    const Image<float>* change = find_channel(run, "ao_stage_" + std::string(ao_stage_names[k]) + ".Y");
    if (change != nullptr) figures.push_back(ao_stage_figure(static_cast<AoStage>(k), *change));
  }
  if (run.ao_stages && run.ao_stages->total.pixels > 0) all.waterfalls.push_back(ao_stages_waterfall(*run.ao_stages));
  return all;
}

}  // namespace umbrameter
