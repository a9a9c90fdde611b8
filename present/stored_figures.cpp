#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "present/presentation_parts.h"
#include "present/run_page.h"
#include "present/sweep_report.h"
#include "store/finished_sweep.h"
#include "store/read_bias_curves.h"
#include "store/run_value.h"

namespace umbrameter {
namespace {

// Title and caption of the same figures of the run itself, which know the technique and its settings.
void take_titles(std::vector<Figure>& figures, const RunResults& results) {
  std::map<std::string, FigureHead> heads;
  for (const Presentation& part : measured_parts(results.scene, *results.measurement)) {
    for (const Figure& figure : part.figures) heads.emplace(head_of(figure).stem, head_of(figure));
  }
  for (Figure& figure : figures) {
    const auto found = heads.find(head_of(figure).stem);
    if (found == heads.end()) continue;
    head_of(figure).title = found->second.title;
    head_of(figure).caption = found->second.caption;
  }
}

}  // namespace

bool has_stored_cells(const std::filesystem::path& folder, const StoredRun& run) {
  std::error_code error;
  return run.command == "sweep" && std::filesystem::is_regular_file(folder / "results.sqlite", error);
}

std::vector<Figure> stored_figures(const std::filesystem::path& folder, const StoredRun& run) {
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
  std::optional<RunResults> results = read_run_value(folder, false);
  if (results && results->measurement) {
    results->measurement->layers = run.images;
    take_titles(all.figures, *results);
  }
  if (has_stored_cells(folder, run)) {
    const FinishedSweep sweep(folder);
    const SweepResults rows = sweep.rows();
    const std::optional<BiasCurves> curves = results ? results->sweep->curves : read_bias_curves(rows);
    std::ranges::move(present_sweep(rows, best_rows(rows), curves, {}, are_all_equal(rows)).figures,
                      std::back_inserter(all.figures));
  }
  return std::move(all.figures);
}

}  // namespace umbrameter
