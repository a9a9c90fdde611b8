#include "present/stored_figures.h"

#include <utility>

#include "present/ao_stages_report.h"
#include "present/presentation_parts.h"

namespace umbrameter {

Figures stored_figures(const StoredRun& run) {
  Presentation all;
  const auto add = [&](Layer layer, const std::string& light, std::string title, std::string caption) {
    add_layer_figure(all, run.images, layer, light, std::move(title), std::move(caption));
  };
  for (const auto& [title, light] : run.layers) {
    add(Layer::truth_visibility, light, "Reference: " + title, "Visibility of the reference.");
    add(Layer::raster_visibility, light, "Shadow map: " + title, "Visibility of the technique.");
    add(Layer::error_visibility, light, "Error: " + title, error_caption);
    add(Layer::classes, light, "Causes: " + title, classes_caption);
  }
  add(Layer::truth_ao, "", "Reference: ambient occlusion", "Accessibility of the reference.");
  add(Layer::raster_ao, "", "Ambient occlusion", "Accessibility of the technique.");
  add(Layer::error_ao, "", "Error: ambient occlusion", error_caption);
  add(Layer::error_image, "", "Error: the image", image_error_caption);
  add(Layer::cause_image, "", "Cause of the image's error", image_cause_caption);
  add_ao_stage_figures(all, run.images);
  if (run.ao_stages && run.ao_stages->total.pixels > 0) add_figure(all, ao_stages_waterfall(*run.ao_stages));
  return {std::move(all.images), {}, {}, std::move(all.waterfalls)};
}

}  // namespace umbrameter
