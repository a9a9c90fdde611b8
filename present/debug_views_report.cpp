#include <fmt/format.h>

#include <algorithm>

#include "present/presentation_parts.h"
#include "results/layers.h"

namespace umbrameter {
namespace {

using Colors = Image<glm::u8vec3>;

// Draws the views along the lower edge, from the left, with further rows above. Leaves out what does not fit.
std::size_t draw_overlays(Colors& picture, const std::vector<DebugView>& views) {
  constexpr int columns = 5;
  const int gap = std::max(picture.width / 160, 1);
  const int width = (picture.width - gap) / columns - gap;
  int column = 0;
  int bottom = picture.height - gap;
  int tallest = 0;
  for (const DebugView& view : views) {
    const Colors& from = view.picture;
    const int height = std::max(width * from.height / std::max(from.width, 1), 1);
    if (bottom - height < 0) return static_cast<std::size_t>(&view - views.data());
    const int left = gap + column * (width + gap);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const bool is_frame = x == 0 || y == 0 || x == width - 1 || y == height - 1;
        picture.pixels[picture.index(left + x, bottom - height + y)] =
            is_frame ? glm::u8vec3(255) : from.pixels[from.index(x * from.width / width, y * from.height / height)];
      }
    }
    tallest = std::max(tallest, height);
    if (++column < columns) continue;
    column = 0;
    bottom -= tallest + gap;
    tallest = 0;
  }
  return views.size();
}

}  // namespace

Presentation present_debug_views(const Measurement& measurement) {
  Presentation presentation;
  presentation.section.title = "Debug views";
  const std::vector<DebugView>& views = measurement.debug_views;
  ImageFigure image;
  image.stem = "overlay";
  image.title = "The image with overlays";
  image.color = tone_map(colors_of(measurement.layers, Layer::raster_image),
                         static_cast<float>(measurement.experiment.shading.exposure));
  const std::size_t drawn = draw_overlays(image.color, views);
  image.caption = "From the left, bottom row first:";
  for (std::size_t i = 0; i < drawn; ++i) image.caption += (i == 0 ? " " : "; ") + views[i].title;
  image.caption += drawn < views.size() ? fmt::format(". {} more do not fit.", views.size() - drawn) : ".";
  add_figure(presentation, std::move(image));
  for (const DebugView& view : views) {
    ImageFigure figure;
    figure.stem = view.stem;
    figure.title = view.title;
    figure.caption = view.caption;
    figure.color = view.picture;
    add_figure(presentation, std::move(figure));
  }
  return presentation;
}

}  // namespace umbrameter
