#include "present/stored_figures.h"

#include <algorithm>
#include <cmath>

#include "present/ao_stages_report.h"
#include "present/error_backdrop.h"
#include "present/presentation.h"
#include "results/layer_description.h"

namespace umbrameter {
namespace {

constexpr const char* error_caption = "Technique − reference: blue is too dark, red is too bright.";

void add_scalar(std::vector<ImageFigure>& figures, const StoredRun& run, Layer layer, const std::string& light,
                const std::string& title, const std::string& caption) {
  const std::string name = layer_name(layer, light);
  const Image<float>* values = find_channel(run, name + ".Y");
  if (values == nullptr) return;
  ImageFigure& figure = figures.emplace_back();
  figure.stem = name;
  figure.title = title;
  figure.caption = caption;
  figure.values = *values;
  hide_uncounted(figure.values, name, *run.images);
  figure.scale = color_scale(layer);
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
    add_scalar(figures, run, Layer::truth_visibility, layer, "Reference: " + light, "Visibility of the reference.");
    add_scalar(figures, run, Layer::raster_visibility, layer, "Shadow map: " + light, "Visibility of the technique.");
    add_scalar(figures, run, Layer::error_visibility, layer, "Error: " + light, error_caption);
    add_classes(figures, run, layer_name(Layer::classes, layer), "Causes: " + light,
                "Main cause of the wrong taps of each pixel.", class_colors());
  }
  add_scalar(figures, run, Layer::truth_ao, "", "Reference: ambient occlusion", "Accessibility of the reference.");
  add_scalar(figures, run, Layer::raster_ao, "", "Ambient occlusion", "Accessibility of the technique.");
  add_scalar(figures, run, Layer::error_ao, "", "Error: ambient occlusion", error_caption);
  add_scalar(figures, run, Layer::error_image, "", "Error: the image", "Luminance, technique − reference.");
  add_classes(figures, run, layer_name(Layer::cause_image), "Cause of the image's error",
              "The input that matters most: replacing it by the reference's changes the pixel most. Only where the "
              "error is visible.",
              image_cause_colors());
  for (std::size_t k = 0; k < ao_stage_count; ++k) {
    const Image<float>* change =
        find_channel(run, layer_name(static_cast<Layer>(static_cast<std::size_t>(Layer::ao_stage_model) + k)) + ".Y");
    if (change != nullptr) figures.push_back(ao_stage_figure(static_cast<AoStage>(k), *change));
  }
  if (run.ao_stages && run.ao_stages->total.pixels > 0) all.waterfalls.push_back(ao_stages_waterfall(*run.ao_stages));
  return all;
}

}  // namespace umbrameter
