// Pictures of numbers and of images. Each is written to figures/<stem>.svg, .pdf and .png.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/image.h"
#include "core/math.h"
#include "core/table.h"
#include "reports/figures/hatch.h"
#include "reports/figures/style.h"

namespace umbrameter {

/// How numbers become colours. All maps are perceptually uniform, safe for colour-blind readers, and readable grey.
enum class ColorMap : int {
  visibility,  ///< sequential, dark is 0: shares and accessibility
  error,       ///< diverging about 0: raster − truth, blue is too dark, red is too bright
};

/// One range for every picture of its kind, so that two runs can be compared.
struct ColorScale {
  ColorMap map = ColorMap::visibility;
  double first = 0.0;
  double last = 1.0;
  std::string label;  ///< quantity and unit, beside the colour bar: "visibility [1]"
};

struct CategoryColor {
  std::string name;
  glm::u8vec3 color;
  Hatch hatch = Hatch::none;  ///< of areas in print
};

struct FigureHead {
  std::string stem{};
  std::string title{};
  std::string conditions{};  ///< what holds for all of a plot, drawn below a title: "shadow.filter = nearest"
  std::string caption{};     ///< what the figure shows; the page prints it beside the figure
};

/// An image with frame and colour bar or category legend.
struct ImageFigure : FigureHead {
  /// One of: scalar values with a scale; category index per pixel (into categories); display colours (sRGB).
  Image<float> values;
  ColorScale scale;
  Image<std::uint8_t> category;
  std::vector<CategoryColor> categories;
  Image<glm::u8vec3> color;
};

struct Axis {
  std::string column;  ///< of the table
  std::string label;   ///< quantity and unit: "constant bias [m]"
  bool logarithmic = false;
  bool square_root = false;  ///< spreads small shares out and has a place for 0
  bool round_ticks = false;  ///< of a logarithmic x: its values, however few, are of a search or measured, not given
};

/// Lines of y against x, one for each value of the series column, with a band where both bounds are given.
struct PlotFigure : FigureHead {
  Axis x;
  Axis y;
  std::optional<std::string> series;           ///< column that tells the lines apart
  std::string series_label;                    ///< legend title with unit: "resolution [texels]"
  std::vector<CategoryColor> series_colors{};  ///< of values that have a colour of their own in other figures, too
  std::optional<std::string> lower, upper;     ///< columns of the 95 % interval
  std::optional<std::string> style;  ///< column that tells solid from dashed lines; colour then tells the series
  std::string style_label;           ///< legend title
  std::optional<std::string> mark;   ///< column of truths: these rows are rings and no part of a line
  bool is_scatter = false;           ///< points that no line joins
  Table data;
};

/// A number over two parameters, x within a panel as a scale, y as rows, the largest on top. Its colours go in steps
/// at quantiles of the cells, closer near the least.
struct HeatMapFigure : FigureHead {
  Axis x;
  Axis y;
  std::optional<std::string> panel;  ///< column that tells the panels apart
  std::string panel_label;
  Axis value;
  std::optional<std::string> mark;  ///< column of truths: these cells get a ring
  Table data;
};

/// One step of a sum.
struct WaterfallStep {
  std::string name;
  std::string note;  ///< below the name: "RMS 0.031"
  double value = 0.0;
  double lower = 0.0;  ///< 95 % interval of the value; equal bounds: none
  double upper = 0.0;
};

/// A sum, step by step: each bar starts where the one before ends. The total starts at 0.
struct WaterfallFigure : FigureHead {
  std::string label;  ///< quantity and unit of the value axis
  std::string below;  ///< what a step below 0 means: "darkens"
  std::string above;
  std::vector<WaterfallStep> steps;
  WaterfallStep total;
};

using Figure = std::variant<ImageFigure, PlotFigure, HeatMapFigure, WaterfallFigure>;

inline const FigureHead& head_of(const Figure& figure) {
  return std::visit([](const FigureHead& head) -> const FigureHead& { return head; }, figure);
}
inline FigureHead& head_of(Figure& figure) {
  return std::visit([](FigureHead& head) -> FigureHead& { return head; }, figure);
}

/// What an image of a comparison is drawn with, besides its own pixels.
struct ErrorImage {
  bool shows_errors = false;           ///< an error map or causes
  Image<std::uint8_t> backdrop{};      ///< light grey picture of the scene behind errors; may be empty
  std::vector<bool> wrong_category{};  ///< of each category of causes
  int right_category = -1;             ///< the backdrop takes its place; −1: none
  std::string part{};                  ///< "sun": images of one part share the inset of most error; empty: none
  std::vector<Inset> insets{};         ///< besides those of the style
};
using ErrorImages = std::map<std::string, ErrorImage>;  ///< by the figure's stem

/// sRGB bytes of a scalar image. NaN is magenta; values outside the scale take its end colours.
Image<glm::u8vec3> colorize(const Image<float>& values, const ColorScale& scale);

/// Linear colours with exposure to sRGB bytes.
Image<glm::u8vec3> tone_map(const Image<vec3>& linear, float exposure);

void write_png(const std::filesystem::path& path, const Image<glm::u8vec3>& image);

/// How many figures are written, of all. Called from any thread, one call at a time.
using FigureProgress = std::function<void(std::size_t done, std::size_t all)>;

/// Draws on all threads at once; the files and the order of the problems do not depend on their number. Returns what
/// was left out and why, one line each; empty when all were written.
std::vector<std::string> write_figures(const std::filesystem::path& folder, const std::vector<Figure>& figures,
                                       const FigureStyle& style = {}, const ErrorImages& errors = {},
                                       const FigureProgress& progress = {});

}  // namespace umbrameter
