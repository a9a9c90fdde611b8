// What write_figures() puts together: the SVG of an image figure, the Vega-Lite specification of a plot.
#pragma once

#include <string>

#include "core/image.h"
#include "core/math.h"
#include "reports/figures/error_image.h"
#include "reports/figures/figures.h"
#include "reports/figures/svg_drawing.h"
#include "reports/files/png.h"

namespace umbrameter {

/// Pixels at their place in a drawing.
struct PlacedImage {
  Image<glm::u8vec3> pixels;  ///< enlarged by a whole number where they are small
  DeflatedImage deflated;     ///< the same, as SVG and PDF hold them
  ivec2 corner{0, 0};         ///< of the top left pixel in the drawing [px]
};

/// An image figure as drawn: everything but the image and its insets is SVG, these are pixels. One unit is one pixel.
struct ImageDrawing {
  std::string before;               ///< SVG below the images: background, title
  std::string after;                ///< SVG above the images: frames, marks, colour bar or category legend
  std::vector<PlacedImage> images;  ///< the image, then its insets
  ivec2 size{0, 0};                 ///< of the drawing [px]
  double print_width = 0.0;         ///< [mm]; 0: none, a pixel is a pixel
  std::string font;

  /// All but the images and the background, as SVG.
  std::string frame() const;
};

/// The image at its own pixels, its insets, colour bar or category legend, and the title where the style has one.
/// Throws Error (partial) when the figure has no image, an image without pixels, a category that is not listed, or an
/// inset too large to be enlarged.
ImageDrawing draw(const ImageFigure& figure, const FigureStyle& style = {}, const ErrorImage& error = {});

/// The side of the square that draw() makes of a wrong pixel in the whole image: an odd number of its pixels, about a
/// tenth of a letter's height. 1 where it enlarges none.
int error_dot(const ImageFigure& figure, const ErrorImage& error, const FigureStyle& style);

/// A self-contained SVG document with the images embedded as PNG.
std::string to_svg(const ImageDrawing& drawing);

/// The drawing as PDF and as PNG, one pixel a unit: the images below its frame(), so that each of their pixels keeps
/// its colour. Throws Error (partial) when the frame cannot be drawn.
std::string to_pdf(const ImageDrawing& drawing, const SvgDrawing& frame);
std::string to_png(const ImageDrawing& drawing, const SvgDrawing& frame);

/// JSON text. Throws Error (partial) when the table lacks a column that the figure names.
std::string to_plot_specification(const PlotFigure& figure, const FigureStyle& style = {});
std::string to_plot_specification(const HeatMapFigure& figure, const FigureStyle& style = {});
std::string to_plot_specification(const WaterfallFigure& figure, const FigureStyle& style = {});

}  // namespace umbrameter
