#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "compare/image_error.h"
#include "compare/metrics/color_space.h"
#include "compare/visibility.h"
#include "present/presentation_parts.h"
#include "results/layers.h"

namespace umbrameter {
namespace {

Image<std::uint8_t> backdrop_of(const LayeredImage& layers) {
  const std::array<const Image<float>*, 4> rgba = {find_channel(layers, "R"), find_channel(layers, "G"),
                                                   find_channel(layers, "B"), find_channel(layers, "A")};
  if (std::ranges::find(rgba, nullptr) != rgba.end()) return {};
  Image<std::uint8_t> grey(rgba[0]->width, rgba[0]->height);
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const bool is_surface = (*rgba[3])[i] > 0.0f;
    grey[i] = backdrop_grey(is_surface ? luminance(vec3((*rgba[0])[i], (*rgba[1])[i], (*rgba[2])[i])) : -1.0);
  }
  return grey;
}

// Which figures show one part of a run: those of one light, of ambient occlusion or of the shaded image. A blank keeps
// the latter apart from lights of these names. Empty for figures that compare nothing.
std::string part_of(const NamedLayer& layer) {
  const LayerDescription& d = *layer.description;
  const bool is_stage = d.layer >= Layer::ao_stage_model && d.layer <= Layer::ao_stage_blur;
  if (d.role == ViewerRole::other && !is_stage) return {};
  return d.subject == LayerSubject::light ? layer.light : d.subject == LayerSubject::ao ? " ao" : " image";
}

}  // namespace

ErrorImages error_images_of(const std::vector<Figure>& figures, const LayeredImage& layers, const std::string& prefix) {
  const Image<std::uint8_t> backdrop = backdrop_of(layers);
  ErrorImages errors;
  for (const Figure& each : figures) {
    const auto* const figure = std::get_if<ImageFigure>(&each);
    if (figure == nullptr || !figure->stem.starts_with(prefix)) continue;
    const std::optional<NamedLayer> layer = find_layer(std::string_view(figure->stem).substr(prefix.size()));
    ErrorImage error;
    if (layer) error.part = part_of(*layer);
    if (error.part.empty()) continue;
    const LayerDescription& described = *layer->description;
    if (described.layer == Layer::classes) {
      error.right_category = static_cast<int>(PixelClass::correct);
      error.wrong_category.assign(static_cast<std::size_t>(PixelClass::light_leak) + 1, true);
      error.wrong_category.front() = false;
    } else if (described.layer == Layer::cause_image) {
      error.right_category = static_cast<int>(image_cause_count);
      error.wrong_category.assign(image_cause_count, true);
    }
    error.shows_errors = described.role == ViewerRole::error || !error.wrong_category.empty();
    if (error.shows_errors && image_size(*figure) == ivec2(backdrop.width, backdrop.height)) error.backdrop = backdrop;
    errors.emplace(figure->stem, std::move(error));
  }
  return errors;
}

ErrorImages error_images_of(const std::vector<Figure>& figures, const RunResults& results) {
  if (results.measurement) return error_images_of(figures, results.measurement->layers);
  ErrorImages errors;
  if (!results.tune) return errors;
  // Images of all points share their parts, so that the insets show the same region.
  for (const TunePointImages& point : results.tune->points) {
    errors.merge(error_images_of(figures, point.measurement.layers, stem_prefix(point)));
  }
  return errors;
}

void hide_uncounted(Image<float>& values, std::string_view layer, const LayeredImage& layers) {
  const std::optional<NamedLayer> named = find_layer(layer);
  if (!named || named->description->layer != Layer::error_visibility) return;
  const Image<float>* counted = find_values(layers, Layer::counted, named->light);
  const Image<float>* classes = find_values(layers, Layer::classes, named->light);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if ((counted != nullptr && (*counted)[i] == 0.0f) ||
        (classes != nullptr && (*classes)[i] >= static_cast<float>(PixelClass::not_counted))) {
      values[i] = 0.0f;
    }
  }
}

}  // namespace umbrameter
