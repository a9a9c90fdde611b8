#include "experiments/presentation/tune_images.h"

#include <fmt/format.h>

#include <utility>

#include "experiments/layers.h"
#include "experiments/presentation/page_cells.h"
#include "experiments/presentation/page_viewer.h"
#include "experiments/presentation/tune_text.h"

namespace umbrameter {
namespace {

std::vector<ImageFigure> figures_of(const TuneCase& tuned, const Measurement& measurement) {
  if (measurement.ao) return present_ao(*measurement.ao).images;
  if (measurement.image) return present_image(*tuned.stages, *measurement.image).images;
  return present_shadow(*tuned.stages, measurement.shadows.front()).images;
}

}  // namespace

ViewerPack add_tune_images(Presentation& part, const TuneSummary& summary) {
  const TuneCase& first = summary.cases.front();
  Stages& stages = *first.stages;
  ViewerPack pack;
  pack.title = "Best and default point";
  const auto add = [&](const char* name, const Experiment& experiment, const std::string& values) {
    const Measurement measurement = measure_swept(stages, experiment, first.quantity);
    ViewerData data = viewer_data(stages, measurement, layers_of(stages, measurement), false);
    data.title = fmt::format("{}: {}; {}", name, values, first.title);
    add_set(pack, data);
    for (ImageFigure& figure : figures_of(first, measurement)) {
      // Both points have the same reference.
      if (figure.stem.starts_with("truth_") && std::string_view(name) != "best") continue;
      figure.stem = std::string(name) + "_" + figure.stem;
      figure.caption += fmt::format(" The {} point in {}.", name, first.title);
      pack.layers.insert(figure.stem);
      add_figure(part, std::move(figure));
    }
  };
  const TuneResult& result = summary.result;
  add("best", at_point(first, summary.axes, result.best.values), point_text(summary.axes, result.best.values));
  add("default", stages.in_metres(first.experiment), point_text(summary.axes, result.before.values));
  return pack;
}

}  // namespace umbrameter
