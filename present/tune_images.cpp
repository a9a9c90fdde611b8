#include "present/tune_images.h"

#include <fmt/format.h>

#include <utility>

#include "present/page_viewer.h"

namespace umbrameter {
namespace {

std::vector<ImageFigure> figures_of(const SceneFacts& scene, const Measurement& measurement) {
  const LayeredImage& layers = measurement.layers;
  if (measurement.ao) return present_ao(layers, *measurement.ao).images;
  if (measurement.image) return present_image(scene, layers, *measurement.image).images;
  return present_shadow(scene, layers, measurement.shadows.front()).images;
}

}  // namespace

ViewerPack add_tune_images(Presentation& part, const SceneFacts& scene, const TuneFindings& tune) {
  ViewerPack pack;
  pack.title = "Best and default point";
  const std::string& title = tune.summary.cases.front();
  for (const TunePointImages& point : tune.points) {
    ViewerData data = viewer_data(scene, point.measurement, false);
    data.title = fmt::format("{}: {}; {}", point.name, point.values, title);
    add_set(pack, data);
    for (ImageFigure& figure : figures_of(scene, point.measurement)) {
      // All points have the same reference.
      if (figure.stem.starts_with("truth_") && &point != &tune.points.front()) continue;
      figure.stem = point.name + "_" + figure.stem;
      figure.caption += fmt::format(" The {} point in {}.", point.name, title);
      pack.layers.insert(figure.stem);
      add_figure(part, std::move(figure));
    }
  }
  return pack;
}

}  // namespace umbrameter
