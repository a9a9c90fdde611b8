#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "reports/figures/figure_parts.h"
#include "reports/files/markup.h"
#include "reports/files/png.h"

namespace umbrameter {
namespace {

constexpr int min_width = 480;    // smaller images are shown with whole-numbered enlargement
constexpr int max_height = 1600;  // of an enlarged image
constexpr int bar_ticks = 5;

// Lengths follow the width of the image, so that a figure scaled to a column has letters of the same size. Those of a
// flat image follow its height instead: letters would else take many times the area of the image.
struct Layout {
  int width = 0;   // of the image as shown or min_width, px
  int height = 0;  // of the image as shown, px
  int unit = 0;    // font size of labels, px
  int margin() const { return unit; }
  int image_top() const { return unit * 11 / 4; }
  int below() const { return image_top() + height + unit; }
};

std::string number_text(double value, double range) {
  if (std::abs(value) < 1e-9 * range) return "0";
  std::string text = fmt::format("{:.4g}", value);
  if (text.front() == '-') text.replace(0, 1, "−");
  return text;
}

Image<glm::u8vec3> enlarge(const Image<glm::u8vec3>& image, int factor) {
  if (factor == 1) return image;
  Image<glm::u8vec3> result(image.width * factor, image.height * factor);
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) result.at(x, y) = image.at(x / factor, y / factor);
  }
  return result;
}

Image<glm::u8vec3> category_colors(const ImageFigure& figure) {
  Image<glm::u8vec3> colors(figure.category.width, figure.category.height);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    if (figure.category[i] >= figure.categories.size()) {
      throw Error(ExitCode::partial, "figure " + figure.stem,
                  fmt::format("category {} has no name and colour", figure.category[i]));
    }
    colors[i] = figure.categories[figure.category[i]].color;
  }
  return colors;
}

Image<glm::u8vec3> colors_of(const ImageFigure& figure) {
  if (!figure.values.empty()) return colorize(figure.values, figure.scale);
  if (!figure.category.empty()) return category_colors(figure);
  if (!figure.color.empty()) return figure.color;
  throw Error(ExitCode::partial, "figure " + figure.stem, "it has no image or one without pixels");
}

std::string png_element(const Image<glm::u8vec3>& image, int x, int y, int width, int height) {
  return fmt::format(
      "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
      "xlink:href=\"{}\"/>\n",
      x, y, width, height, data_uri("image/png", to_png(image)));
}

std::string frame(int x, int y, int width, int height) {
  return fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#777777\" stroke-width=\"1\"/>\n",
      x - 0.5, y - 0.5, width + 1, height + 1);
}

std::string text_element(double x, double y, int size, const char* anchor, std::string_view text,
                         const char* more = "") {
  return fmt::format("<text x=\"{:g}\" y=\"{:g}\" font-size=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, size,
                     anchor, more, escape_markup(text));
}

std::string swatch(int x, int y, int size, const glm::u8vec3& color) {
  return fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#{:02x}{:02x}{:02x}\" stroke=\"#777777\"/>\n", x + 0.5,
      y + 0.5, size - 1, size - 1, color.x, color.y, color.z);
}

// Returns the height used.
int add_color_bar(std::string& svg, const Layout& layout, const ImageFigure& figure) {
  const int x = layout.margin();
  const int y = layout.below();
  const int height = std::max(8, layout.unit * 3 / 4);
  const ColorScale& scale = figure.scale;
  Image<float> ramp(std::min(layout.width, 1024), 1);
  const double range = scale.last - scale.first;
  for (int i = 0; i < ramp.width; ++i) {
    ramp.at(i, 0) = static_cast<float>(scale.first + range * i / std::max(1, ramp.width - 1));
  }
  svg += png_element(colorize(ramp, scale), x, y, layout.width, height);
  svg += frame(x, y, layout.width, height);
  const int tick_end = y + height + layout.unit / 4;
  for (int i = 0; i < bar_ticks; ++i) {
    const double share = static_cast<double>(i) / (bar_ticks - 1);
    const double tick = x + std::round(share * layout.width) + (i == 0 ? -0.5 : 0.5);
    svg += fmt::format("<path d=\"M{:g},{}V{}\" stroke=\"#777777\"/>\n", tick, y + height, tick_end);
    const char* anchor = i == 0 ? "start" : i + 1 == bar_ticks ? "end" : "middle";
    svg += text_element(tick, tick_end + layout.unit, layout.unit, anchor,
                        number_text(scale.first + share * range, std::abs(range)));
  }
  const int label = tick_end + layout.unit * 5 / 2;
  const bool has_gaps =
      std::any_of(figure.values.pixels.begin(), figure.values.pixels.end(), [](float v) { return std::isnan(v); });
  svg += text_element(x + 0.5 * layout.width, label, layout.unit, "middle", scale.label);
  if (has_gaps) {
    svg += swatch(x, label - layout.unit * 4 / 5, layout.unit, {255, 0, 255});
    svg += text_element(x + layout.unit * 1.4, label, layout.unit, "start", "no value");
  }
  return label + layout.unit / 2 - layout.below();
}

// Swatches with names in columns, as many as fit. Returns the height used.
int add_categories(std::string& svg, const Layout& layout, const std::vector<CategoryColor>& categories) {
  double widest = 0.0;
  for (const CategoryColor& category : categories) widest = std::max(widest, text_width(category.name));
  const int column = static_cast<int>(layout.unit * (2.4 + widest));
  const int columns = std::max(1, (layout.width + layout.unit) / column);
  const int line = layout.unit * 7 / 4;
  for (std::size_t i = 0; i < categories.size(); ++i) {
    const int x = layout.margin() + static_cast<int>(i) % columns * column;
    const int y = layout.below() + static_cast<int>(i) / columns * line;
    svg += swatch(x, y, layout.unit, categories[i].color);
    svg += text_element(x + 1.4 * layout.unit, y + 0.85 * layout.unit, layout.unit, "start", categories[i].name);
  }
  const int lines = (static_cast<int>(categories.size()) + columns - 1) / columns;
  return lines * line;
}

}  // namespace

ImageDrawing draw(const ImageFigure& figure) {
  const Image<glm::u8vec3> original = colors_of(figure);
  const int enlargement = std::min((min_width + original.width - 1) / original.width, max_height / original.height);
  ImageDrawing drawing;
  drawing.pixels = enlarge(original, std::max(1, enlargement));
  const Image<glm::u8vec3>& image = drawing.pixels;
  const int shown_width = std::max(image.width, min_width);
  const Layout layout{shown_width, image.height, std::max(13, std::min(shown_width / 42, image.height / 4))};
  drawing.corner = {layout.margin(), layout.image_top()};
  drawing.after = frame(drawing.corner.x, drawing.corner.y, image.width, image.height);
  int height = layout.image_top() + image.height + layout.margin();
  if (!figure.values.empty()) height = layout.below() + add_color_bar(drawing.after, layout, figure);
  if (figure.values.empty() && !figure.category.empty()) {
    height = layout.below() + add_categories(drawing.after, layout, figure.categories);
  }
  drawing.after += "</svg>\n";
  const int width = layout.width + 2 * layout.margin();
  // A title that is wider than the picture is set smaller, down to half the size; the factor is for bold letters.
  const double fitting_size = layout.width / std::max(1.0, 1.1 * text_width(figure.title));
  const int title_size = static_cast<int>(std::clamp(fitting_size, layout.unit * 0.5, layout.unit * 1.2));
  drawing.before =
      fmt::format(
          "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" version=\"1.1\" "
          "width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" font-family=\"DejaVu Sans, sans-serif\" "
          "fill=\"#1a1a1a\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
          width, height) +
      text_element(layout.margin(), layout.unit * 1.9, title_size, "start", figure.title, " font-weight=\"bold\"");
  return drawing;
}

std::string to_svg(const ImageDrawing& drawing) {
  const Image<glm::u8vec3>& image = drawing.pixels;
  return drawing.before + png_element(image, drawing.corner.x, drawing.corner.y, image.width, image.height) +
         drawing.after;
}

std::string to_png(const ImageDrawing& drawing, const std::string& frame_png) {
  Image<glm::u8vec3> page = from_png(frame_png);
  const Image<glm::u8vec3>& image = drawing.pixels;
  const glm::ivec2 corner = drawing.corner;
  if (corner.x + image.width > page.width || corner.y + image.height > page.height) {
    throw Error(ExitCode::partial, "PNG", "the drawing is smaller than the image in it");
  }
  for (int y = 0; y < image.height; ++y) {
    const auto row = image.pixels.begin() + static_cast<std::ptrdiff_t>(y) * image.width;
    std::copy_n(row, image.width, &page.at(corner.x, corner.y + y));
  }
  return to_png(page);
}

}  // namespace umbrameter
