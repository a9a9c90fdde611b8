#include "present/error_backdrop.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "compare/image_error.h"
#include "compare/metrics/color_space.h"
#include "compare/visibility.h"

namespace umbrameter {
namespace {

const Image<float>* channel_of(const LayeredImage& layers, std::string_view name) {
  const auto found = std::find_if(layers.channels.begin(), layers.channels.end(),
                                  [&](const Channel& channel) { return channel.name == name; });
  return found == layers.channels.end() ? nullptr : &found->values;
}

Image<std::uint8_t> backdrop_of(const LayeredImage& layers) {
  const std::array<const Image<float>*, 4> rgba = {channel_of(layers, "R"), channel_of(layers, "G"),
                                                   channel_of(layers, "B"), channel_of(layers, "A")};
  if (std::find(rgba.begin(), rgba.end(), nullptr) != rgba.end()) return {};
  Image<std::uint8_t> grey(rgba[0]->width, rgba[0]->height);
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const bool is_surface = (*rgba[3])[i] > 0.0f;
    grey[i] = backdrop_grey(is_surface ? luminance(vec3((*rgba[0])[i], (*rgba[1])[i], (*rgba[2])[i])) : -1.0);
  }
  return grey;
}

// A blank keeps the parts of AO and image apart from lights of these names. "sun" of "error_visibility_sun", " ao" and
// " image" of their layers; empty for all other figures.
std::string part_of(std::string_view layer) {
  for (const std::string_view quantity : {"truth_visibility_", "raster_visibility_", "error_visibility_", "class_"}) {
    if (layer.starts_with(quantity)) return std::string(layer.substr(quantity.size()));
  }
  for (const char* layer_of_ao : {"truth_ao", "raster_ao", "error_ao"}) {
    if (layer == layer_of_ao) return " ao";
  }
  if (layer.starts_with("ao_stage_")) return " ao";
  for (const char* layer_of_image : {"truth_image", "raster_image", "error_image", "cause_image"}) {
    if (layer == layer_of_image) return " image";
  }
  return {};
}

}  // namespace

ErrorImages error_images_of(const std::vector<ImageFigure>& figures, const LayeredImage& layers) {
  const Image<std::uint8_t> backdrop = backdrop_of(layers);
  ErrorImages errors;
  for (const ImageFigure& figure : figures) {
    const std::string_view layer = figure.stem;
    ErrorImage error;
    error.part = part_of(layer);
    if (error.part.empty()) continue;
    if (layer.starts_with("class_")) {
      error.right_category = static_cast<int>(PixelClass::correct);
      error.wrong_category.assign(static_cast<std::size_t>(PixelClass::light_leak) + 1, true);
      error.wrong_category.front() = false;
    } else if (layer == "cause_image") {
      error.right_category = static_cast<int>(image_cause_count);
      error.wrong_category.assign(image_cause_count, true);
    }
    error.shows_errors = layer.starts_with("error_") || !error.wrong_category.empty();
    if (error.shows_errors && image_size(figure) == ivec2(backdrop.width, backdrop.height)) error.backdrop = backdrop;
    errors.emplace(figure.stem, std::move(error));
  }
  return errors;
}

void hide_uncounted(Image<float>& values, std::string_view layer, const LayeredImage& layers) {
  constexpr std::string_view prefix = "error_visibility_";
  if (!layer.starts_with(prefix)) return;
  const std::string light(layer.substr(prefix.size()));
  const Image<float>* counted = channel_of(layers, "counted_" + light + ".Y");
  const Image<float>* classes = channel_of(layers, "class_" + light + ".Y");
  for (std::size_t i = 0; i < values.size(); ++i) {
    if ((counted != nullptr && (*counted)[i] == 0.0f) ||
        (classes != nullptr && (*classes)[i] >= static_cast<float>(PixelClass::not_counted))) {
      values[i] = 0.0f;
    }
  }
}

}  // namespace umbrameter
