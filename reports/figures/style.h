// The size, the letters and the enlarged regions of figures: for the screen, or for a place in print.
#pragma once

#include <string>
#include <vector>

#include "core/math.h"

namespace umbrameter {

/// A region of an image, drawn enlarged beside it [px].
struct Inset {
  int x = 0;  ///< of its left column
  int y = 0;  ///< of its top row
  int width = 0;
  int height = 0;
};

/// As given on the command line; empty or 0 where nothing is given.
struct FigureOptions {
  std::string style;   ///< "column", "page" or "slide"
  std::string size;    ///< "WIDTH" or "WIDTHxHEIGHT" [mm]
  std::string font;    ///< family
  double font_size{};  ///< [pt]
  bool title = false;
  std::vector<std::string> insets;  ///< "X,Y,WIDTH,HEIGHT" [px]
};

/// What all figures of a run have in common.
struct FigureStyle {
  double width = 0.0;      ///< of a drawing in print [mm]; 0: for the screen, one unit a pixel
  double height = 0.0;     ///< of a plot in print [mm]; 0: automatic
  double font_size = 8.0;  ///< of labels in print [pt]
  double dpi = 300.0;      ///< of the PNG of a plot in print
  std::string font = "DejaVu Sans";
  bool with_title = false;
  std::vector<Inset> insets;  ///< regions of the images that are `view` large
  glm::ivec2 view{0, 0};      ///< [px]

  bool is_print() const { return width > 0.0; }
};

/// A one-column figure, a figure over both columns, and a 16:9 slide of 339 mm. Sizes and fonts override the style's.
/// Throws Error (usage) for what is not understood or out of range.
FigureStyle make_figure_style(const FigureOptions& options);

/// Throws Error (usage) if an inset is not inside an image of this size.
void check_insets(const FigureStyle& style, int width, int height);

/// Font size of labels in a plot's units: those of the screen, where a unit is a pixel. A plot for print is drawn in
/// the same units and scaled as a whole, so that lines, dashes and markers keep their proportions to the letters.
inline constexpr double plot_font_size = 13.0;

inline constexpr double points_per_mm = 72.0 / 25.4;

/// Units of a plot in a millimetre of print.
double plot_units_per_mm(const FigureStyle& style);

}  // namespace umbrameter
