// What write_figures() puts together: the SVG of an image figure, the Vega-Lite specification of a plot.
#pragma once

#include <string>

#include "reports/figures.h"

namespace umbrameter {

/// A self-contained SVG document: title, the image at its own pixels, colour bar or category legend.
/// Throws Error (partial) when the figure has no image, an image without pixels, or a category that is not listed.
std::string to_svg(const ImageFigure& figure);

/// JSON text. Throws Error (partial) when the table lacks a column that the figure names.
std::string to_plot_specification(const PlotFigure& figure);
std::string to_plot_specification(const HeatMapFigure& figure);

}  // namespace umbrameter
