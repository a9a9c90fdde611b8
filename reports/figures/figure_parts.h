// What write_figures() puts together: the SVG of an image figure, the Vega-Lite specification of a plot.
#pragma once

#include <string>

#include "core/image.h"
#include "core/math.h"
#include "reports/figures/figures.h"

namespace umbrameter {

/// An image figure as drawn: everything but the image itself is SVG, the image is pixels.
struct ImageDrawing {
  std::string before;         ///< SVG below the image: header, background, title
  std::string after;          ///< SVG above the image: frame, colour bar or category legend
  Image<glm::u8vec3> pixels;  ///< the image, enlarged by a whole number where it is small
  glm::ivec2 corner{0};       ///< of the image's top left pixel in the drawing, px

  /// The drawing without its image.
  std::string frame() const { return before + after; }
};

/// Title, the image at its own pixels, colour bar or category legend.
/// Throws Error (partial) when the figure has no image, an image without pixels, or a category that is not listed.
ImageDrawing draw(const ImageFigure& figure);

/// A self-contained SVG document with the image embedded as PNG.
std::string to_svg(const ImageDrawing& drawing);

/// The drawing as PNG, one pixel a unit: the image pasted into the frame's PNG, so that each of its pixels keeps its
/// colour. Throws Error (partial) when `frame_png` is not a PNG that holds the image's place.
std::string to_png(const ImageDrawing& drawing, const std::string& frame_png);

/// JSON text. Throws Error (partial) when the table lacks a column that the figure names.
std::string to_plot_specification(const PlotFigure& figure);
std::string to_plot_specification(const HeatMapFigure& figure);
std::string to_plot_specification(const WaterfallFigure& figure);

}  // namespace umbrameter
