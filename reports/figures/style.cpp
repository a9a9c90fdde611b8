#include "reports/figures/style.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>

#include "core/error.h"
#include "core/lists.h"

namespace umbrameter {
namespace {

struct NamedStyle {
  const char* name;
  double width;      // [mm]
  double height;     // [mm]
  double font_size;  // [pt]
  double dpi;
};

// A column of ACM, IEEE, Elsevier and Eurographics is 84 to 90 mm wide, their text 176 mm or more; their captions have
// 8 to 9 pt. A slide of PowerPoint is 338.7 × 190.5 mm, with room for a heading above the figure.
constexpr std::array<NamedStyle, 3> styles = {
    {{"column", 84.0, 0.0, 8.0, 300.0}, {"page", 176.0, 0.0, 8.0, 300.0}, {"slide", 300.0, 145.0, 20.0, 150.0}}};

constexpr double min_side = 20.0;    // [mm]
constexpr double max_side = 2000.0;  // [mm]

void set_size(FigureStyle& style, const std::string& text) {
  const std::optional<std::vector<double>> size = parsed_list<double>(text, 'x');
  const auto fits = [](double side) { return side >= min_side && side <= max_side; };
  if (!size || size->size() > 2 || !std::all_of(size->begin(), size->end(), fits)) {
    throw Error(ExitCode::usage, "--figure-size " + text, "not a size in millimetres",
                fmt::format("give WIDTH or WIDTHxHEIGHT from {:g} to {:g}, such as 84x60", min_side, max_side));
  }
  style.width = size->front();
  style.height = size->size() > 1 ? size->back() : 0.0;
}

Inset parse_inset(const std::string& text) {
  if (text == "worst") return {};  // no region yet: add_worst_insets() finds it
  const std::optional<std::vector<int>> numbers = parsed_list<int>(text, ',');
  if (!numbers || numbers->size() != 4 || (*numbers)[2] < 1 || (*numbers)[3] < 1) {
    throw Error(ExitCode::usage, "--inset " + text, "not a rectangle in pixels",
                "give X,Y,WIDTH,HEIGHT from the top left, such as 100,80,60,40, or worst");
  }
  return {(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
}

// A family becomes part of SVG and of CSS.
bool is_font_name(std::string_view name) {
  return std::ranges::all_of(
      name, [](unsigned char c) { return std::isalnum(c) != 0 || c == ' ' || c == '-' || c == '_' || c >= 0x80; });
}

}  // namespace

FigureStyle make_figure_style(const FigureOptions& options) {
  FigureStyle style;
  if (!options.style.empty()) {
    const auto named = std::ranges::find(styles, options.style, &NamedStyle::name);
    if (named == styles.end()) {
      throw Error(ExitCode::usage, "--figure-style " + options.style, "unknown style", "use column, page or slide");
    }
    style.width = named->width;
    style.height = named->height;
    style.font_size = named->font_size;
    style.dpi = named->dpi;
  }
  if (!options.size.empty()) set_size(style, options.size);
  if (options.font_size != 0.0) {
    if (!style.is_print()) {
      throw Error(ExitCode::usage, "--figure-font-size", "figures for the screen have no size in points",
                  "add --figure-style or --figure-size");
    }
    style.font_size = options.font_size;
  }
  if (!options.font.empty()) {
    if (!is_font_name(options.font)) {
      throw Error(ExitCode::usage, "--figure-font " + options.font, "not the name of a font family",
                  "'fc-list : family' lists the installed ones");
    }
    style.font = options.font;
  }
  style.with_title = options.title;
  for (const std::string& text : options.insets) style.insets.push_back(parse_inset(text));
  return style;
}

void check_insets(const FigureStyle& style, int width, int height) {
  for (const Inset& inset : style.insets) {
    if (inset.width == 0) continue;
    const bool is_inside = inset.x >= 0 && inset.y >= 0 && inset.x < width && inset.y < height &&
                           inset.width <= width - inset.x && inset.height <= height - inset.y;
    if (is_inside) continue;
    throw Error(ExitCode::usage, fmt::format("--inset {},{},{},{}", inset.x, inset.y, inset.width, inset.height),
                fmt::format("it is not inside the image of {}×{} pixels", width, height));
  }
}

double plot_units_per_mm(const FigureStyle& style) { return points_per_mm * plot_font_size / style.font_size; }

}  // namespace umbrameter
