#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "reports/figures/figure_parts.h"
#include "reports/figures/figures.h"
#include "reports/figures/inset.h"
#include "reports/figures/plot_parts.h"
#include "reports/figures/style.h"
#include "reports/files/png.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

FigureStyle style_of(const std::string& name) {
  FigureOptions options;
  options.style = name;
  return make_figure_style(options);
}

ImageFigure checker(int width, int height) {
  ImageFigure figure;
  figure.stem = "checker";
  figure.title = "A checkerboard";
  figure.scale = {ColorMap::visibility, 0.0, 1.0, "visibility [1]"};
  figure.values = Image<float>(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) figure.values.at(x, y) = static_cast<float>((7 * x + 13 * y) % 11) / 10.0f;
  }
  return figure;
}

PlotFigure lines(int count) {
  PlotFigure figure;
  figure.stem = "lines";
  figure.title = "Mean absolute error";
  figure.conditions = "shadow.filter = box";
  figure.x = {"bias", "constant bias [m]"};
  figure.y = {"mae", "mean absolute error [%]"};
  figure.series = "resolution";
  figure.series_label = "resolution [texels]";
  figure.data.columns = {{"bias", "m", ""}, {"mae", "%", ""}, {"resolution", "texels", ""}};
  for (int line = 0; line < count; ++line) {
    for (int i = 0; i < 20; ++i) {
      figure.data.rows.push_back({0.01 * i, 5.0 + i * (line + 1), std::int64_t{256} << line});
    }
  }
  return figure;
}

HeatMapFigure map_of_panels() {
  HeatMapFigure figure;
  figure.stem = "map";
  figure.title = "Error";
  figure.x = {"bias", "constant bias [m]"};
  figure.y = {"slope", "slope bias [texels]"};
  figure.panel = "resolution";
  figure.panel_label = "resolution [texels]";
  figure.value = {"mae", "mean absolute error [%]"};
  figure.data.columns = {{"bias", "m", ""}, {"slope", "texels", ""}, {"resolution", "texels", ""}, {"mae", "%", ""}};
  for (int i = 0; i < 36; ++i) {
    figure.data.rows.push_back({0.01 * (i % 4), 1.0 * (i / 4 % 3), std::int64_t{256} << (i / 12), 0.3 * i});
  }
  return figure;
}

WaterfallFigure sum_of_steps() {
  WaterfallFigure figure;
  figure.stem = "sum";
  figure.title = "Error by stage";
  figure.label = "technique − reference [1]";
  figure.below = "darkens";
  figure.above = "brightens";
  figure.steps = {{"model", "RMS 0.2", -0.25, -0.26, -0.24}, {"hidden", "", 0.5}, {"blur", "", -0.125}};
  figure.total = {"total", "RMS 0.3", 0.125};
  return figure;
}

// "width="84.00mm"" of the first tag.
double width_in_mm(const std::string& svg) {
  const std::size_t at = svg.find(" width=\"");
  const std::size_t end = svg.find('"', at + 8);
  EXPECT_EQ(svg.substr(end - 2, 2), "mm") << svg.substr(0, 200);
  return std::stod(svg.substr(at + 8));
}

double second_box_number(const std::string& svg, int index) {
  std::size_t at = svg.find("viewBox=\"") + 9;
  for (int i = 0; i < index; ++i) at = svg.find(' ', at) + 1;
  return std::stod(svg.substr(at));
}

std::vector<Figure> one_of_each() { return {checker(320, 180), lines(3), map_of_panels(), sum_of_steps()}; }

// Columns of journals are 84 to 90 mm wide, their pages 176 mm or more; the slide is 339 mm.
// Labels have 8 pt in a column and on a page, 20 pt on a slide: the drawing's unit is its width over the viewBox's.
TEST(FigureStyle, Every_kind_of_figure_has_the_width_of_its_place_in_svg_and_pdf_and_labels_of_its_size) {
  struct Place {
    const char* name;
    double width;   // mm
    double points;  // of labels
  };
  const TemporaryFolder folder;
  for (const auto& [name, width, points] : {Place{"column", 84.0, 8.0}, {"page", 176.0, 8.0}, {"slide", 300.0, 20.0}}) {
    const std::filesystem::path figures = folder / name;
    const std::vector<std::string> problems = write_figures(figures, one_of_each(), style_of(name));
    ASSERT_TRUE(problems.empty()) << problems.front();
    for (const std::string stem : {"checker", "lines", "map", "sum"}) {
      const std::string svg = text_of(figures / (stem + ".svg"));
      EXPECT_NEAR(width_in_mm(svg), width, 0.01) << name << " " << stem;
      EXPECT_EQ(text_of(figures / (stem + ".pdf")).substr(0, 5), "%PDF-");
      const double unit = width_in_mm(svg) * points_per_mm / second_box_number(svg, 2);  // [pt]
      if (stem == "checker") {
        const std::size_t at = svg.find("font-size=\"") + 11;
        EXPECT_NEAR(std::stod(svg.substr(at)) * unit, points, 0.05 * points) << name << ": whole pixels";
      } else {
        EXPECT_NEAR(plot_font_size * unit, points, 0.03 * points) << name << " " << stem;
      }
    }
  }
}

// 300 mm at 150 pixels per inch are 1772 pixels: six times 320, and twice 960. 84 mm are 497, which 640 exceed.
TEST(FigureStyle, An_image_in_print_has_at_least_150_pixels_per_inch) {
  const auto pixels_of = [](int width, const char* style) {
    return draw(checker(width, width * 9 / 16), style_of(style)).images.front().pixels.width;
  };
  EXPECT_EQ(pixels_of(320, "slide"), 6 * 320);
  EXPECT_EQ(pixels_of(960, "slide"), 2 * 960);
  EXPECT_EQ(pixels_of(640, "column"), 640);
  EXPECT_EQ(draw(checker(100, 1000), style_of("slide")).images.front().pixels.height, 4 * 1000) << "at most 4096";
}

// Upright, "mean absolute error of all of the counted pixels, in per cent of them" is longer than this plot is high.
TEST(FigureStyle, A_long_title_of_the_value_axis_does_not_shrink_a_plot_of_given_height) {
  FigureStyle style = style_of("slide");
  PlotFigure figure = lines(2);
  figure.y.label = "mean absolute error of all of the counted pixels, in per cent of them";
  const Json title = Json::parse(to_plot_specification(figure, style))["layer"][0]["encoding"]["y"]["axis"]["title"];
  ASSERT_TRUE(title.is_array()) << title;
  // 145 mm at 72/25.4 points, 20 of which are 13 units: 267 units, less 110 for what stands below the plot.
  for (const Json& line : title) EXPECT_LE(6.8 * static_cast<double>(line.get<std::string>().size()), 157.0) << line;
}

// 280 units of height hold 41 characters of 6.8 units.
TEST(FigureStyle, Long_labels_of_axes_and_legends_are_set_in_lines) {
  PlotFigure figure = lines(2);
  figure.x.label = figure.series_label =
      "an axis whose label is much longer than a plot in a column is wide, with its unit [m]";
  figure.y.label = "mean absolute error of all of the counted pixels, in per cent of them";
  const FigureStyle style = style_of("column");
  const Json spec = Json::parse(to_plot_specification(figure, style));
  const Json& encoding = spec["layer"][0]["encoding"];
  for (const Json& label :
       {spec["encoding"]["x"]["axis"]["title"], encoding["y"]["axis"]["title"], encoding["color"]["legend"]["title"]}) {
    ASSERT_TRUE(label.is_array()) << label;
    EXPECT_GE(label.size(), 2u);
    for (const Json& line : label)
      EXPECT_LE(line.get<std::string>().size(), 45u) << "84 mm are 387 units, less 75, of 6.8";
  }
  for (const Json& line : encoding["y"]["axis"]["title"]) EXPECT_LE(line.get<std::string>().size(), 41u);
}

TEST(FigureStyle, A_title_is_drawn_only_if_asked_for) {
  EXPECT_EQ(to_svg(draw(checker(64, 36))).find("A checkerboard"), std::string::npos);
  EXPECT_FALSE(Json::parse(to_plot_specification(lines(2))).contains("title"));
  FigureOptions options;
  options.title = true;
  const FigureStyle titled = make_figure_style(options);
  EXPECT_NE(to_svg(draw(checker(64, 36), titled)).find("A checkerboard"), std::string::npos);
  const Json title = Json::parse(to_plot_specification(lines(2), titled))["title"];
  EXPECT_EQ(title["text"], "Mean absolute error");
  EXPECT_EQ(title["subtitle"][0], "shadow.filter = box");
}

TEST(FigureStyle, Font_and_sizes_override_the_style) {
  FigureOptions options;
  options.style = "slide";
  options.size = "120x60";
  options.font = "Liberation Serif";
  options.font_size = 11.0;
  const FigureStyle style = make_figure_style(options);
  EXPECT_EQ(style.width, 120.0);
  EXPECT_EQ(style.height, 60.0);
  EXPECT_EQ(style.font_size, 11.0);
  EXPECT_NE(to_svg(draw(checker(64, 36), style)).find("font-family=\"Liberation Serif"), std::string::npos);
  EXPECT_EQ(Json::parse(to_plot_specification(lines(2), style))["config"]["font"], "Liberation Serif");
}

TEST(FigureStyle, What_is_not_understood_is_an_error_of_usage) {
  const auto code_of = [](const FigureOptions& options) {
    try {
      make_figure_style(options);
    } catch (const Error& error) {
      return error.code();
    }
    return ExitCode::ok;
  };
  const auto with = [](auto FigureOptions::*member, auto value) {
    FigureOptions options;
    options.*member = value;
    return options;
  };
  EXPECT_EQ(code_of(with(&FigureOptions::style, "poster")), ExitCode::usage);
  for (const char* size : {"x", "84x", "84x60x3", "10", "84mm", "nan", "9999"}) {
    EXPECT_EQ(code_of(with(&FigureOptions::size, size)), ExitCode::usage) << size;
  }
  EXPECT_EQ(code_of(with(&FigureOptions::font, "a\";}<script>")), ExitCode::usage);
  EXPECT_EQ(code_of(with(&FigureOptions::font_size, 9.0)), ExitCode::usage) << "the screen has no points";
  for (const char* inset : {"", "1,2,3", "1,2,3,4,5", "1,2,0,4", "1,2,3,-4", "a,b,c,d"}) {
    EXPECT_EQ(code_of(with(&FigureOptions::insets, std::vector<std::string>{inset})), ExitCode::usage) << inset;
  }
}

TEST(FigureStyle, Two_runs_in_print_write_the_same_bytes) {
  const TemporaryFolder folder;
  FigureStyle style = style_of("column");
  style.insets = {{10, 20, 30, 20}};
  style.view = {320, 180};
  for (const char* run : {"first", "second"}) write_figures(folder / run, one_of_each(), style);
  for (const std::string stem : {"checker", "lines", "map", "sum"}) {
    for (const char* format : {".svg", ".pdf", ".png"}) {
      EXPECT_TRUE(text_of(folder / "first" / (stem + format)) == text_of(folder / "second" / (stem + format)))
          << stem << format;
    }
  }
}

TEST(Inset, Each_pixel_is_a_square_of_its_own_colour) {
  FigureStyle style = style_of("column");
  style.view = {640, 360};
  style.insets = {{100, 80, 40, 30}, {500, 300, 60, 50}};
  const ImageFigure figure = checker(640, 360);
  const Image<glm::u8vec3> colors = colorize(figure.values, figure.scale);
  const ImageDrawing drawing = draw(figure, style);
  ASSERT_EQ(drawing.images.size(), 3u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Inset& region = style.insets[i];
    const Image<glm::u8vec3>& pixels = drawing.images[i + 1].pixels;
    const int scale = pixels.width / region.width;
    ASSERT_EQ(pixels.width, scale * region.width);
    ASSERT_EQ(pixels.height, scale * region.height);
    EXPECT_GT(scale, drawing.images[0].pixels.width / 640) << "larger than in the image";
    for (int y = 0; y < pixels.height; ++y) {
      for (int x = 0; x < pixels.width; ++x) {
        ASSERT_EQ(pixels.at(x, y), colors.at(region.x + x / scale, region.y + y / scale)) << x << ", " << y;
      }
    }
  }
}

TEST(Inset, Insets_overlap_neither_the_image_nor_each_other) {
  for (const ivec2 image : {ivec2(640, 360), ivec2(360, 640), ivec2(1920, 300)}) {
    for (std::size_t count = 1; count <= 4; ++count) {
      std::vector<Inset> insets;
      for (std::size_t i = 0; i < count; ++i) insets.push_back({static_cast<int>(20 * i), 10, 40, 30});
      const InsetLayout layout = place_insets(insets, image, 1, 8);
      std::vector<std::pair<ivec2, ivec2>> boxes = {{ivec2(0, 0), image * layout.image_scale}};
      for (const PlacedInset& each : layout.insets) {
        boxes.emplace_back(each.corner, each.corner + each.scale * ivec2(each.region.width, each.region.height));
      }
      for (std::size_t a = 0; a < boxes.size(); ++a) {
        EXPECT_LE(boxes[a].second.x, layout.size.x);
        EXPECT_LE(boxes[a].second.y, layout.size.y);
        for (std::size_t b = 0; b < a; ++b) {
          const bool is_apart = boxes[a].first.x >= boxes[b].second.x || boxes[b].first.x >= boxes[a].second.x ||
                                boxes[a].first.y >= boxes[b].second.y || boxes[b].first.y >= boxes[a].second.y;
          EXPECT_TRUE(is_apart) << a << " and " << b << " of " << count;
        }
      }
    }
  }
}

TEST(Inset, Only_images_of_the_view_have_insets_and_a_region_outside_of_it_is_an_error) {
  FigureStyle style;
  style.view = {640, 360};
  style.insets = {{100, 80, 40, 30}};
  EXPECT_EQ(draw(checker(512, 512), style).images.size(), 1u);
  EXPECT_NO_THROW(check_insets(style, 640, 360));
  EXPECT_THROW(check_insets(style, 139, 360), Error);
  EXPECT_THROW(check_insets(style, 640, 109), Error);
  style.insets = {{0, 0, 640, 360}};
  EXPECT_THROW(draw(checker(640, 360), style), Error) << "the whole image cannot be enlarged beside itself";
}

TEST(Grey, Neighbouring_lines_differ_in_their_dashes) {
  for (int count = 2; count <= 14; ++count) {
    const Json spec = Json::parse(to_plot_specification(lines(count)));
    for (const Json& layer : spec["layer"]) {
      if (!layer["encoding"].contains("strokeDash")) continue;
      const Json& dashes = layer["encoding"]["strokeDash"]["scale"]["range"];
      ASSERT_EQ(dashes.size(), static_cast<std::size_t>(count));
      for (std::size_t i = 1; i < dashes.size(); ++i) EXPECT_NE(dashes[i], dashes[i - 1]) << i << " of " << count;
    }
  }
}

TEST(Grey, Where_dashes_tell_a_cause_markers_tell_the_series) {
  PlotFigure figure = lines(3);
  figure.data.columns.push_back({"cause", "", ""});
  for (std::vector<Value>& row : figure.data.rows) row.emplace_back(std::string("acne"));
  figure.style = "cause";
  const Json spec = Json::parse(to_plot_specification(figure));
  Json shapes;
  for (const Json& layer : spec["layer"]) {
    if (layer["encoding"].contains("shape")) shapes = layer["encoding"]["shape"]["scale"]["range"];
  }
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_NE(shapes[0], shapes[1]);
  EXPECT_NE(shapes[1], shapes[2]);
  std::map<std::string, int> marked;
  for (const Json& row : spec["data"]["values"]) marked[row["s"]] += row["q"].get<bool>() ? 1 : 0;
  for (const auto& [name, count] : marked) EXPECT_EQ(count, 5) << name << ": 20 points, each fourth";
}

TEST(Grey, Bars_differ_in_hatching) {
  const std::string patterns = Json::parse(to_plot_specification(sum_of_steps()))["usermeta"]["patterns"];
  for (const char* id : {"below", "above", "sum"}) {
    EXPECT_NE(patterns.find("<pattern id=\"" + std::string(id) + "\""), std::string::npos) << id;
  }
  EXPECT_GE(std::abs(lightness({0, 114, 178}) - lightness({230, 159, 0})), 20.0);
  const TemporaryFolder folder;
  write_figures(folder / "figures", {sum_of_steps()});
  const std::string svg = text_of(folder / "figures/sum.svg");
  EXPECT_NE(svg.find("fill=\"url(#above)\""), std::string::npos);
  EXPECT_NE(svg.find("<defs><pattern"), std::string::npos);
}

// IEC 61966-2-1 and CIE 15: white is 100, black 0, and sRGB 119 is the middle grey of 50.
TEST(Grey, Lightness_is_that_of_the_CIE) {
  EXPECT_NEAR(lightness({255, 255, 255}), 100.0, 1e-9);
  EXPECT_EQ(lightness({0, 0, 0}), 0.0);
  EXPECT_NEAR(lightness({119, 119, 119}), 50.0, 0.1);
}

TEST(Grey, Hatched_categories_differ_in_print_and_keep_their_colours_on_the_screen) {
  ImageFigure figure;
  figure.stem = "classes";
  figure.category = Image<std::uint8_t>(640, 360, 1);
  figure.categories = {{"correct", {240, 240, 240}}, {"leak", {86, 180, 233}, Hatch::dots}};
  const Image<glm::u8vec3> shown = draw(figure).images[0].pixels;
  EXPECT_TRUE(std::all_of(shown.pixels.begin(), shown.pixels.end(),
                          [](const glm::u8vec3& c) { return c == glm::u8vec3(86, 180, 233); }));
  const Image<glm::u8vec3> printed = draw(figure, style_of("column")).images[0].pixels;
  const auto inked = std::count(printed.pixels.begin(), printed.pixels.end(), hatch_ink({86, 180, 233}));
  const double share = static_cast<double>(inked) / static_cast<double>(printed.size());
  EXPECT_GT(share, 0.03);
  EXPECT_LT(share, 0.4) << "the colour stays the larger part";
}

// A line of the hatching hides a mark that is smaller than their distance, or misses it.
TEST(Grey, Marks_that_are_too_small_for_hatching_keep_their_colour) {
  Image<std::uint8_t> category(12, 9);
  for (int y = 2; y < 6; ++y) {
    for (int x = 3; x < 7; ++x) category.at(x, y) = 1;  // a square of 4
  }
  for (int x = 8; x < 12; ++x) category.at(x, 4) = 1;  // a line
  category.at(1, 8) = 1;
  const Image<std::uint8_t> large = hatchable(category, 4);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 12; ++x) {
      const bool is_in_square = x >= 3 && x < 7 && y >= 2 && y < 6;
      if (category.at(x, y) == 1) {
        EXPECT_EQ(large.at(x, y), is_in_square) << x << ", " << y;
      }
    }
  }
  ImageFigure figure;
  figure.stem = "classes";
  figure.category = Image<std::uint8_t>(640, 360);
  figure.categories = {{"correct", {240, 240, 240}}, {"leak", {86, 180, 233}, Hatch::dots}};
  for (int i = 0; i < 300; i += 3) figure.category.at(2 * i, i) = 1;
  const Image<glm::u8vec3> printed = draw(figure, style_of("column")).images[0].pixels;
  EXPECT_EQ(std::count(printed.pixels.begin(), printed.pixels.end(), hatch_ink({86, 180, 233})), 0);
  EXPECT_EQ(std::count(printed.pixels.begin(), printed.pixels.end(), glm::u8vec3(86, 180, 233)), 100);
}

}  // namespace
}  // namespace umbrameter
