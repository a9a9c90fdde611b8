#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "reports/figures/error_image.h"
#include "reports/figures/figure_parts.h"
#include "reports/figures/inset.h"
#include "reports/files/markup.h"
#include "reports/files/png.h"

namespace umbrameter {
namespace {

constexpr int min_width = 480;        // smaller images are shown with whole-numbered enlargement
constexpr int max_height = 1600;      // of an enlarged image
constexpr double min_dpi = 150.0;     // of an image in print, by whole-numbered enlargement, too
constexpr int max_print_side = 4096;  // of an image enlarged for print
constexpr int bar_ticks = 5;
constexpr double print_margin = 0.25;  // font sizes

// Lengths follow the width of the pictures, so that a figure scaled to a column has letters of the same size. Those of
// a flat image follow its height instead: letters would else take many times the area of the image.
struct Layout {
  int width = 0;   // of the image with its insets as shown or min_width, px
  int height = 0;  // of the same, px
  int unit = 0;    // font size of labels, px
  int margin = 0;
  int image_top = 0;
  int below() const { return image_top + height + unit; }
};

// How many pixels of the drawing, along a side, stand for one of the image.
int enlargement_of(ivec2 size, const FigureStyle& style) {
  int width = min_width;
  int limit = max_height;
  if (style.is_print()) {
    width =
        std::max(width, static_cast<int>(std::min<double>(max_print_side, std::ceil(style.width / 25.4 * min_dpi))));
    limit = max_print_side;
  }
  return std::max(1, std::min((width + size.x - 1) / size.x, limit / size.y));
}

Layout make_layout(int width, int height, const FigureStyle& style) {
  Layout layout;
  layout.width = std::max(width, min_width);
  layout.height = height;
  if (style.is_print()) {
    // The drawing is scaled to the width of its place, and its letters then have their size in points.
    const double share = style.font_size / (style.width * points_per_mm);
    layout.unit = std::max(1, static_cast<int>(std::lround(layout.width * share / (1.0 - 2.0 * print_margin * share))));
    layout.margin = std::max(2, static_cast<int>(std::lround(print_margin * layout.unit)));
  } else {
    layout.unit = std::max(13, std::min(layout.width / 42, height / 4));
    layout.margin = layout.unit;
  }
  layout.image_top = style.with_title ? layout.unit * 11 / 4 : layout.margin;
  return layout;
}

std::string number_text(double value, double range) {
  if (std::abs(value) < 1e-9 * range) return "0";
  std::string text = fmt::format("{:.4g}", value);
  if (text.front() == '-') text.replace(0, 1, "−");
  return text;
}

Image<glm::u8vec3> category_colors(const ImageFigure& figure, const ErrorImage& error,
                                   const Image<std::uint8_t>& category) {
  Image<glm::u8vec3> colors(category.width, category.height);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    if (category[i] >= figure.categories.size()) {
      throw Error(ExitCode::partial, "figure " + figure.stem,
                  fmt::format("category {} has no name and colour", category[i]));
    }
    const bool is_scene = category[i] == error.right_category && !error.backdrop.empty();
    colors[i] = is_scene ? glm::u8vec3(error.backdrop[i]) : figure.categories[category[i]].color;
  }
  return colors;
}

// One colour for each pixel of the image, and its category where it has one.
struct Pixels {
  Image<glm::u8vec3> colors;
  Image<std::uint8_t> category;
};

// Wrong pixels become squares of dot × dot.
Pixels pixels_of(const ImageFigure& figure, const ErrorImage& error, int dot) {
  if (!figure.values.empty()) {
    const Image<float> values = dot > 1 ? enlarge_errors(figure.values, figure.scale, dot) : figure.values;
    return {
        error.backdrop.empty() ? colorize(values, figure.scale) : colorize_over(values, figure.scale, error.backdrop),
        {}};
  }
  if (!figure.category.empty()) {
    Image<std::uint8_t> category =
        dot > 1 ? enlarge_errors(figure.category, error.wrong_category, dot) : figure.category;
    Image<glm::u8vec3> colors = category_colors(figure, error, category);
    return {std::move(colors), std::move(category)};
  }
  if (!figure.color.empty()) return {figure.color, {}};
  throw Error(ExitCode::partial, "figure " + figure.stem, "it has no image or one without pixels");
}

std::string png_element(const DeflatedImage& image, int x, int y, int width, int height) {
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

std::string swatch(int x, int y, int size, const std::string& fill) {
  return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\" stroke=\"#777777\"/>\n", x + 0.5,
                     y + 0.5, size - 1, size - 1, fill);
}

std::string hex(const glm::u8vec3& color) { return fmt::format("#{:02x}{:02x}{:02x}", color.x, color.y, color.z); }

// Distance of the lines of hatched areas.
int hatch_period(const Layout& layout) { return std::max(4, layout.unit / 3); }

// Draws the hatching of each category onto the pixels of a region; `scale` pixels stand for one of the image. Marks of
// less than a period keep their plain colour.
void hatch(Image<glm::u8vec3>& pixels, const Image<std::uint8_t>& categories, const ImageFigure& figure, ivec2 corner,
           int scale, int period) {
  const Image<std::uint8_t> is_large = hatchable(categories, (period + scale - 1) / scale);
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0; x < pixels.width; ++x) {
      const ivec2 at = corner + ivec2(x, y) / scale;
      if (is_large.at(at.x, at.y) == 0) continue;
      const CategoryColor& category = figure.categories[categories.at(at.x, at.y)];
      if (is_hatched(category.hatch, x, y, period)) pixels.at(x, y) = hatch_ink(category.color);
    }
  }
}

// Returns the height used.
int add_color_bar(std::string& svg, const Layout& layout, const ImageFigure& figure) {
  const int x = layout.margin;
  const int y = layout.below();
  const int height = std::max(8, layout.unit * 3 / 4);
  const ColorScale& scale = figure.scale;
  Image<float> ramp(std::min(layout.width, 1024), 1);
  const double range = scale.last - scale.first;
  for (int i = 0; i < ramp.width; ++i) {
    ramp.at(i, 0) = static_cast<float>(scale.first + range * i / std::max(1, ramp.width - 1));
  }
  svg += png_element(DeflatedImage(colorize(ramp, scale)), x, y, layout.width, height);
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
  const bool has_gaps = std::ranges::any_of(figure.values.pixels, [](float v) { return std::isnan(v); });
  svg += text_element(x + 0.5 * layout.width, label, layout.unit, "middle", scale.label);
  if (has_gaps) {
    svg += swatch(x, label - layout.unit * 4 / 5, layout.unit, "#ff00ff");
    svg += text_element(x + layout.unit * 1.4, label, layout.unit, "start", "no value");
  }
  return label + layout.unit / 2 - layout.below();
}

// Swatches with names in columns, as many as fit. Returns the height used.
int add_categories(std::string& svg, const Layout& layout, const std::vector<CategoryColor>& categories,
                   bool is_hatched) {
  double widest = 0.0;
  for (const CategoryColor& category : categories) widest = std::max(widest, text_width(category.name));
  const int column = static_cast<int>(layout.unit * (2.4 + widest));
  const int columns = std::max(1, (layout.width + layout.unit) / column);
  const int line = layout.unit * 7 / 4;
  for (std::size_t i = 0; i < categories.size(); ++i) {
    const int x = layout.margin + static_cast<int>(i) % columns * column;
    const int y = layout.below() + static_cast<int>(i) / columns * line;
    const std::string id = fmt::format("hatch{}", i);
    const bool has_pattern = is_hatched && categories[i].hatch != Hatch::none;
    if (has_pattern) svg += hatch_pattern(id, categories[i].hatch, categories[i].color, hatch_period(layout));
    svg += swatch(x, y, layout.unit, has_pattern ? "url(#" + id + ")" : hex(categories[i].color));
    svg += text_element(x + 1.4 * layout.unit, y + 0.85 * layout.unit, layout.unit, "start", categories[i].name);
  }
  const int lines = (static_cast<int>(categories.size()) + columns - 1) / columns;
  return lines * line;
}

// The size is that in print where there is one.
std::string header(const ImageDrawing& drawing) {
  const ivec2 size = drawing.size;
  const std::string shown_size = drawing.print_width > 0.0
                                     ? fmt::format("width=\"{:.2f}mm\" height=\"{:.2f}mm\"", drawing.print_width,
                                                   drawing.print_width * size.y / size.x)
                                     : fmt::format("width=\"{}\" height=\"{}\"", size.x, size.y);
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" version=\"1.1\" {} "
      "viewBox=\"0 0 {} {}\" font-family=\"{}, sans-serif\" fill=\"#1a1a1a\">\n",
      shown_size, size.x, size.y, escape_markup(drawing.font));
}

int inset_gap(int width) { return std::max(8, width / 60); }

// Where everything stands, before a pixel is drawn.
struct Plan {
  InsetLayout pictures;
  Layout layout;
};

Plan make_plan(const ErrorImage& error, ivec2 size, const FigureStyle& style) {
  const int enlargement = enlargement_of(size, style);
  std::vector<Inset> regions = size == style.view ? style.insets : std::vector<Inset>{};
  std::erase_if(regions, [](const Inset& inset) { return inset.width == 0; });
  regions.insert(regions.end(), error.insets.begin(), error.insets.end());
  InsetLayout pictures = place_insets(regions, size, enlargement, inset_gap(size.x * enlargement));
  const Layout layout = make_layout(pictures.size.x, pictures.size.y, style);
  return {std::move(pictures), layout};
}

// The side of a wrong pixel's square: an odd number of pixels of the image, about a tenth of a letter's height.
int dot_of(const ImageFigure& figure, const ErrorImage& error, const Layout& layout, int scale) {
  constexpr double share_of_letter = 0.1;
  if (!has_single_errors(figure, error)) return 1;
  return 2 * std::max(0, static_cast<int>(std::lround((share_of_letter * layout.unit / scale - 1.0) / 2.0))) + 1;
}

}  // namespace

ivec2 image_size(const ImageFigure& figure) {
  if (!figure.values.empty()) return {figure.values.width, figure.values.height};
  if (!figure.category.empty()) return {figure.category.width, figure.category.height};
  return {figure.color.width, figure.color.height};
}

std::string ImageDrawing::frame() const {
  return header(*this) + before.substr(before.find('\n') + 1) + after + "</svg>\n";
}

int error_dot(const ImageFigure& figure, const ErrorImage& error, const FigureStyle& style) {
  if (!error.shows_errors) return 1;
  const Plan plan = make_plan(error, image_size(figure), style);
  return dot_of(figure, error, plan.layout, plan.pictures.image_scale);
}

ImageDrawing draw(const ImageFigure& figure, const FigureStyle& style, const ErrorImage& error) {
  const Pixels exact = pixels_of(figure, error, 1);
  const auto [pictures, layout] = make_plan(error, {exact.colors.width, exact.colors.height}, style);
  const int dot = dot_of(figure, error, layout, pictures.image_scale);
  const Pixels enlarged = dot > 1 ? pixels_of(figure, error, dot) : exact;
  ImageDrawing drawing;
  drawing.font = style.font;
  drawing.print_width = style.width;
  const ivec2 origin(layout.margin, layout.image_top);
  const bool is_hatched = style.is_print() && !figure.category.empty() && figure.values.empty();
  const auto add_picture = [&](const Pixels& pixels, const Inset& region, int scale, ivec2 corner) {
    PlacedImage& picture = drawing.images.emplace_back();
    picture.corner = corner;
    picture.pixels = crop_enlarged(pixels.colors, region, scale);
    if (is_hatched) {
      hatch(picture.pixels, pixels.category, figure, {region.x, region.y}, scale, hatch_period(layout));
    }
    picture.deflated = DeflatedImage(picture.pixels);
  };
  add_picture(enlarged, {0, 0, exact.colors.width, exact.colors.height}, pictures.image_scale, origin);
  for (const PlacedInset& inset : pictures.insets) {
    add_picture(exact, inset.region, inset.scale, origin + inset.corner);
  }
  const Image<glm::u8vec3>& image = drawing.images.front().pixels;
  drawing.after = frame(origin.x, origin.y, image.width, image.height);
  drawing.after += inset_marks(pictures, origin, std::max(1.5, layout.unit / 12.0));
  int height = layout.image_top + layout.height + layout.margin;
  if (!figure.values.empty()) height = layout.below() + add_color_bar(drawing.after, layout, figure);
  if (figure.values.empty() && !figure.category.empty()) {
    height = layout.below() + add_categories(drawing.after, layout, figure.categories, is_hatched);
  }
  drawing.size = {layout.width + 2 * layout.margin, height};
  drawing.before = fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n", drawing.size.x, height);
  if (!style.with_title) return drawing;
  // A title that is wider than the picture is set smaller, down to half the size; the factor is for bold letters.
  const double fitting_size = layout.width / std::max(1.0, 1.1 * text_width(figure.title));
  const int title_size = static_cast<int>(std::clamp(fitting_size, layout.unit * 0.5, layout.unit * 1.2));
  drawing.before +=
      text_element(layout.margin, layout.unit * 1.9, title_size, "start", figure.title, " font-weight=\"bold\"");
  return drawing;
}

std::string to_svg(const ImageDrawing& drawing) {
  std::string svg = header(drawing) + drawing.before;
  for (const PlacedImage& image : drawing.images) {
    svg += png_element(image.deflated, image.corner.x, image.corner.y, image.pixels.width, image.pixels.height);
  }
  return svg + drawing.after + "</svg>\n";
}

std::string to_pdf(const ImageDrawing& drawing, const SvgDrawing& frame) {
  std::vector<ImageBelow> images;
  for (const PlacedImage& image : drawing.images) {
    images.push_back({&image.deflated, image.corner, {image.pixels.width, image.pixels.height}});
  }
  return frame.to_pdf(images);
}

std::string to_png(const ImageDrawing& drawing, const SvgDrawing& frame) {
  Image<glm::u8vec3> page(drawing.size.x, drawing.size.y, glm::u8vec3(255));
  for (const PlacedImage& image : drawing.images) {
    for (int y = 0; y < image.pixels.height; ++y) {
      std::copy_n(&image.pixels.at(0, y), image.pixels.width, &page.at(image.corner.x, image.corner.y + y));
    }
  }
  frame.draw_over(page);
  return to_png(page);
}

}  // namespace umbrameter
