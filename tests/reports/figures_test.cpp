#include "reports/figures/figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"
#include "reports/figures/figure_parts.h"
#include "reports/figures/svg_drawing.h"
#include "reports/files/png.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"
#include "tests/support/variable.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

ImageFigure ramp_figure(int width = 64, int height = 36) {
  ImageFigure figure;
  figure.stem = "ramp";
  figure.title = "Truth: sun";
  figure.scale = {ColorMap::visibility, 0.0, 1.0, "visibility [1]"};
  figure.values = Image<float>(width, height);
  for (std::size_t i = 0; i < figure.values.size(); ++i) {
    figure.values[i] = static_cast<float>(i) / static_cast<float>(figure.values.size());
  }
  return figure;
}

// Two lines of `count` points, given with the larger resolution first.
PlotFigure curve_figure(int count = 20) {
  PlotFigure figure;
  figure.stem = "curve";
  figure.title = "Mean absolute error";
  figure.x = {"bias", "constant bias [m]", false};
  figure.y = {"mae", "mean absolute error [%]", false};
  figure.series = "resolution";
  figure.series_label = "resolution [texels]";
  figure.data.columns = {{"bias", "m", ""}, {"mae", "1", ""}, {"resolution", "texels", ""}};
  for (const int resolution : {1024, 256}) {
    for (int i = 0; i < count; ++i) {
      figure.data.rows.push_back({0.01 * i, 5.0 + 100.0 * i / resolution, std::int64_t{resolution}});
    }
  }
  return figure;
}

TEST(Figures, Each_is_written_as_svg_pdf_and_png) {
  const TemporaryFolder folder;
  const std::vector<std::string> problems = write_figures(folder / "figures", {ramp_figure(), curve_figure()});
  EXPECT_TRUE(problems.empty()) << problems.front();
  EXPECT_EQ(count_files(folder / "figures"), 6u);
  for (const std::string stem : {"ramp", "curve"}) {
    EXPECT_TRUE(contains(text_of(folder / ("figures/" + stem + ".svg")), "</svg>")) << stem;
    EXPECT_EQ(text_of(folder / ("figures/" + stem + ".pdf")).substr(0, 5), "%PDF-") << stem;
    EXPECT_EQ(text_of(folder / ("figures/" + stem + ".png")).substr(0, 4), "\x89PNG") << stem;
  }
}

TEST(Figures, Png_of_an_image_holds_its_pixels_where_the_svg_shows_them) {
  const TemporaryFolder folder;
  const ImageFigure figure = ramp_figure(640, 40);
  write_figures(folder / "figures", {figure});
  const Image<glm::u16vec4> png = from_png(text_of(folder / "figures/ramp.png"));
  const std::string svg = to_svg(draw(figure));
  const Image<glm::u8vec3> rendered = SvgDrawing(svg).pixels(1.0);
  ASSERT_EQ(png.width, rendered.width);
  ASSERT_EQ(png.height, rendered.height);
  for (std::size_t i = 0; i < png.size(); ++i) {
    // Letters are laid over the page with 8 bits.
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(png[i][c] / 257, rendered[i][c], 1) << i;
  }
  const Image<glm::u8vec3> colors = colorize(figure.values, figure.scale);
  const glm::ivec2 corner = draw(figure).images.front().corner;
  for (int y = 0; y < colors.height; ++y) {
    for (int x = 0; x < colors.width; ++x) {
      const glm::u16vec4 code(glm::u16vec3(colors.at(x, y)) * glm::u16vec3(257), 65535);
      ASSERT_EQ(png.at(corner.x + x, corner.y + y), code) << x << ", " << y;
    }
  }
}

TEST(Figures, Two_runs_write_the_same_bytes) {
  const TemporaryFolder folder;
  for (const char* run : {"first", "second"}) write_figures(folder / run, {ramp_figure(), curve_figure()});
  for (const std::string name : {"ramp.svg", "ramp.pdf", "ramp.png", "curve.svg", "curve.pdf", "curve.png"}) {
    EXPECT_TRUE(text_of(folder / ("first/" + name)) == text_of(folder / ("second/" + name))) << name;
  }
}

TEST(Figures, Do_not_depend_on_the_number_of_threads) {
  const TemporaryFolder folder;
  std::vector<ImageFigure> images(5, ramp_figure(320, 180));
  for (std::size_t i = 0; i < images.size(); ++i) images[i].stem = "ramp" + std::to_string(i);
  images[3].values = {};  // nothing to draw: a problem
  std::vector<Figure> figures(images.begin(), images.end());
  figures.emplace_back(curve_figure());
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    const std::vector<std::string> problems = write_figures(folder / std::to_string(threads), figures);
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_TRUE(contains(problems[0], "ramp3")) << problems[0];
  }
  EXPECT_EQ(count_files(folder / "1"), 15u);
  for (const auto& entry : fs::directory_iterator(folder / "1")) {
    EXPECT_TRUE(text_of(entry.path()) == text_of(folder / "4" / entry.path().filename())) << entry.path();
  }
}

TEST(Figures, Are_counted_as_they_are_written) {
  const TemporaryFolder folder;
  ImageFigure second = ramp_figure();
  second.stem = "second";
  std::vector<std::size_t> counted;
  write_figures(folder / "figures", {ramp_figure(), second, curve_figure()}, {}, {},
                [&](std::size_t done, std::size_t all) {
                  EXPECT_EQ(all, 3u);
                  counted.push_back(done);
                });
  EXPECT_EQ(counted, (std::vector<std::size_t>{1, 2, 3}));
}

TEST(Figures, A_machine_without_node_gets_the_images_and_is_told_what_to_install) {
  const TemporaryFolder folder;
  const Variable path("PATH", folder.path().string());
  const std::vector<std::string> problems = write_figures(folder / "figures", {ramp_figure(), curve_figure()});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_TRUE(contains(problems[0], "install nodejs")) << problems[0];
  for (const char* name : {"ramp.svg", "ramp.pdf", "ramp.png"}) EXPECT_TRUE(fs::exists(folder / "figures" / name));
  EXPECT_EQ(count_files(folder / "figures"), 3u);
}

TEST(Figures, A_machine_without_fonts_is_told_what_to_install) {
  const TemporaryFolder folder;
  const fs::path settings = folder / "fonts.conf";
  std::ofstream(settings) << "<fontconfig><dir>" << (folder / "none").string() << "</dir></fontconfig>";
  const Variable fonts("FONTCONFIG_FILE", settings.string());
  const std::vector<std::string> problems = write_figures(folder / "figures", {ramp_figure()});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_TRUE(contains(problems[0], "no font is installed; install fonts-dejavu-core")) << problems[0];
}

TEST(Figures, A_drawing_that_cannot_be_read_is_one_problem_and_the_rest_is_drawn) {
  const TemporaryFolder folder;
  const Variable data("UMBRAMETER_DATA", folder.path().string());
  put_text(folder / "figures.cjs", R"(console.log('[{"svg": "<svg><text>no end"}]'))");
  const std::vector<std::string> problems = write_figures(folder / "figures", {ramp_figure(), curve_figure()});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_TRUE(contains(problems[0], "curve.svg")) << problems[0];
  EXPECT_FALSE(contains(problems[0], "\n")) << problems[0];
  EXPECT_EQ(count_files(folder / "figures"), 4u) << "three of the ramp, and the curve's SVG";
}

// cairo's images have at most 32767 pixels along a side.
TEST(Figures, An_image_too_large_for_a_png_is_a_problem_and_has_its_svg_and_pdf) {
  const TemporaryFolder folder;
  const std::vector<std::string> problems = write_figures(folder / "figures", {ramp_figure(40000, 1)});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_TRUE(contains(problems[0], "ramp.png not made")) << problems[0];
  EXPECT_TRUE(contains(problems[0], "32767")) << problems[0];
  EXPECT_EQ(text_of(folder / "figures/ramp.pdf").substr(0, 5), "%PDF-");
  EXPECT_EQ(count_files(folder / "figures"), 2u);
}

TEST(Figures, A_missing_plot_drawer_is_named) {
  const TemporaryFolder folder;
  const Variable data("UMBRAMETER_DATA", (folder / "nowhere").string());
  const std::vector<std::string> problems = write_figures(folder / "figures", {curve_figure()});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_TRUE(contains(problems[0], (folder / "nowhere/figures.cjs").string())) << problems[0];
}

TEST(Figures, A_broken_plot_drawer_is_a_problem_and_no_crash) {
  const TemporaryFolder folder;
  const Variable data("UMBRAMETER_DATA", folder.path().string());
  for (const std::string script : {"process.exit(3)", "console.log('[]')", "console.log('nonsense')", "throw 1"}) {
    put_text(folder / "figures.cjs", script);
    const std::vector<std::string> problems = write_figures(folder / "figures", {curve_figure()});
    ASSERT_EQ(problems.size(), 1u) << script;
    EXPECT_TRUE(contains(problems[0], "1 plot not drawn")) << problems[0];
  }
}

TEST(Figures, Hostile_texts_stay_texts) {
  const TemporaryFolder folder;
  FigureStyle style;
  style.with_title = true;
  const std::string hostile = "</text><script>alert(1)</script> & \"quotes\" \x01 \xff\xfe end";
  ImageFigure image = ramp_figure();
  image.title = hostile;
  image.scale.label = hostile;
  PlotFigure plot = curve_figure();
  plot.title = plot.caption = plot.x.label = plot.y.label = plot.series_label = hostile;
  for (std::vector<Value>& row : plot.data.rows) row[2] = hostile;
  const std::vector<std::string> problems = write_figures(folder / "figures", {image, plot}, style);
  EXPECT_TRUE(problems.empty()) << problems.front();
  EXPECT_EQ(count_files(folder / "figures"), 6u);
  for (const char* name : {"ramp.svg", "curve.svg"}) {
    const std::string svg = text_of(folder / "figures" / name);
    EXPECT_FALSE(contains(svg, "<script")) << name;
    EXPECT_TRUE(contains(svg, "&lt;script")) << name;
  }
}

TEST(Figures, What_cannot_be_drawn_is_a_problem_and_the_rest_is_drawn) {
  const TemporaryFolder folder;
  ImageFigure empty;
  empty.stem = "empty";
  ImageFigure unknown_category;
  unknown_category.stem = "unknown";
  unknown_category.category = Image<std::uint8_t>(4, 4, 9);
  unknown_category.categories = {{"only", {1, 2, 3}}};
  PlotFigure no_column = curve_figure();
  no_column.stem = "no_column";
  no_column.y.column = "missing";
  const std::vector<std::string> problems =
      write_figures(folder / "figures", {empty, unknown_category, ramp_figure(), no_column, curve_figure()});
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_TRUE(contains(problems[0], "empty")) << problems[0];
  EXPECT_TRUE(contains(problems[1], "category 9")) << problems[1];
  EXPECT_TRUE(contains(problems[2], "'missing'")) << problems[2];
  EXPECT_EQ(count_files(folder / "figures"), 6u);
}

TEST(Figures, A_stem_cannot_leave_the_folder) {
  const TemporaryFolder folder;
  for (const char* stem : {"../outside", "/outside", "", ".hidden", "a/b"}) {
    ImageFigure figure = ramp_figure(4, 4);
    figure.stem = stem;
    EXPECT_EQ(write_figures(folder / "figures", {figure}).size(), 1u) << stem;
  }
  EXPECT_EQ(count_files(folder.path()), 1u);
  EXPECT_EQ(count_files(folder / "figures"), 0u);
}

TEST(Figures, A_folder_that_cannot_be_made_is_an_error_that_names_it) {
  const TemporaryFolder folder;
  put_text(folder / "file", "x");
  try {
    write_figures(folder / "file/figures", {ramp_figure()});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::partial);
    EXPECT_TRUE(contains(error.what(), (folder / "file/figures").string())) << error.what();
  }
}

TEST(Figures, Images_of_extreme_shape_are_drawn) {
  const TemporaryFolder folder;
  std::vector<ImageFigure> figures;
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{1, 3000}, std::pair{5000, 1}}) {
    figures.push_back(ramp_figure(width, height));
    figures.back().stem = "shape" + std::to_string(width) + "x" + std::to_string(height);
  }
  EXPECT_TRUE(write_figures(folder / "figures", {figures.begin(), figures.end()}).empty());
  EXPECT_EQ(count_files(folder / "figures"), 9u);
}

TEST(ImageFigure, A_large_image_keeps_its_pixels_and_a_small_one_is_enlarged_by_a_whole_number) {
  EXPECT_TRUE(contains(to_svg(draw(ramp_figure(1280, 720))), "width=\"1280\" height=\"720\" preserveAspectRatio"));
  // 8 · 64 = 512 is the first multiple of 64 from 480 on; 8 · 36 = 288.
  EXPECT_TRUE(contains(to_svg(draw(ramp_figure(64, 36))), "width=\"512\" height=\"288\" preserveAspectRatio"));
}

// Letters of a 42nd of the width would make this drawing 3000 pixels high and its PNG one of 50 million pixels.
TEST(ImageFigure, The_letters_of_a_flat_image_do_not_outgrow_it) {
  const auto height_of = [](const std::string& svg) { return std::stoi(svg.substr(svg.find("height=\"") + 8)); };
  EXPECT_LT(height_of(to_svg(draw(ramp_figure(16384, 1)))), 200);
  EXPECT_LT(height_of(to_svg(draw(ramp_figure(16384, 400)))), 3 * 400);
  // Those of a usual picture are as large as its width has them: 1280 / 42 = 30.
  EXPECT_TRUE(contains(to_svg(draw(ramp_figure(1280, 720))), "font-size=\"30\""));
}

TEST(ImageFigure, The_colour_bar_names_the_ends_of_the_scale_not_of_the_image) {
  ImageFigure figure = ramp_figure();
  figure.scale = {ColorMap::error, -0.5, 0.5, "raster − truth [1]"};
  const std::string svg = to_svg(draw(figure));
  for (const char* text : {">−0.5<", ">−0.25<", ">0<", ">0.25<", ">0.5<", ">raster − truth [1]<"}) {
    EXPECT_TRUE(contains(svg, text)) << text;
  }
}

TEST(ImageFigure, Gaps_are_explained_where_there_are_any) {
  ImageFigure figure = ramp_figure();
  EXPECT_FALSE(contains(to_svg(draw(figure)), "no value"));
  figure.values[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(contains(to_svg(draw(figure)), "no value"));
}

TEST(ImageFigure, Every_category_has_its_swatch) {
  ImageFigure figure;
  figure.stem = "classes";
  figure.category = Image<std::uint8_t>(8, 8, 1);
  figure.categories = {{"correct", {236, 236, 236}}, {"acne", {213, 94, 0}}};
  const std::string svg = to_svg(draw(figure));
  EXPECT_TRUE(contains(svg, "fill=\"#ececec\"")) << "236 is 0xec";
  EXPECT_TRUE(contains(svg, "fill=\"#d55e00\"")) << "213, 94, 0 in hexadecimal";
  EXPECT_TRUE(contains(svg, ">correct<"));
  EXPECT_TRUE(contains(svg, ">acne<"));
}

TEST(PlotFigure, Lines_are_ordered_by_number_not_by_text_or_row) {
  EXPECT_TRUE(contains(to_plot_specification(curve_figure()), "\"domain\":[\"256\",\"1024\"]"));
}

TEST(PlotFigure, Few_points_have_markers_and_many_have_none) {
  EXPECT_TRUE(contains(to_plot_specification(curve_figure(12)), "\"point\""));
  EXPECT_FALSE(contains(to_plot_specification(curve_figure(13)), "\"point\""));
}

TEST(PlotFigure, A_logarithmic_axis_says_how_many_points_it_cannot_show) {
  PlotFigure figure = curve_figure(3);
  EXPECT_FALSE(contains(to_plot_specification(figure), "Not shown"));
  figure.x.logarithmic = true;  // the first bias of both lines is 0
  EXPECT_TRUE(contains(to_plot_specification(figure), "Not shown: 2 of 6 points"));
}

TEST(PlotFigure, Values_that_are_no_number_are_left_out_and_counted) {
  PlotFigure figure = curve_figure(3);
  figure.data.rows[1][1] = std::numeric_limits<double>::quiet_NaN();
  figure.data.rows[2][1] = std::numeric_limits<double>::infinity();
  const std::string specification = to_plot_specification(figure);
  EXPECT_TRUE(contains(specification, "Not shown: 2 of 6 points")) << specification;
}

TEST(PlotFigure, A_band_needs_both_bounds) {
  PlotFigure figure = curve_figure(3);
  figure.lower = "mae";
  EXPECT_FALSE(contains(to_plot_specification(figure), "\"area\""));
  figure.upper = "mae";
  EXPECT_TRUE(contains(to_plot_specification(figure), "\"area\""));
}

TEST(PlotFigure, No_rows_one_row_and_a_choice_as_abscissa_are_drawn) {
  const TemporaryFolder folder;
  PlotFigure none = curve_figure(0);
  none.stem = "none";
  PlotFigure empty_logarithmic = none;
  empty_logarithmic.stem = "empty_logarithmic";
  empty_logarithmic.x.logarithmic = empty_logarithmic.y.logarithmic = true;
  PlotFigure one = curve_figure(1);
  one.stem = "one";
  PlotFigure choice = curve_figure(2);
  choice.stem = "choice";
  choice.series.reset();
  for (std::vector<Value>& row : choice.data.rows) row[0] = std::string("box");
  const std::vector<std::string> problems = write_figures(folder / "figures", {none, empty_logarithmic, one, choice});
  EXPECT_TRUE(problems.empty()) << problems.front();
  EXPECT_TRUE(contains(text_of(folder / "figures/none.svg"), "No data"));
  EXPECT_TRUE(contains(text_of(folder / "figures/choice.svg"), ">box<"));
}

TEST(PlotFigure, A_scatter_plot_has_any_number_of_points_and_no_line) {
  PlotFigure figure = curve_figure(40);
  figure.is_scatter = true;
  const std::string specification = to_plot_specification(figure);
  EXPECT_TRUE(contains(specification, "\"type\":\"point\""));
  EXPECT_FALSE(contains(specification, "\"type\":\"line\""));
  EXPECT_FALSE(contains(specification, "\"strokeDash\"")) << "the legend shows what is drawn";
}

TEST(PlotFigure, Choices_are_not_joined_by_lines) {
  PlotFigure figure = curve_figure(3);
  for (std::vector<Value>& row : figure.data.rows)
    row[0] = std::string(std::get<double>(row[0]) > 0.0 ? "box" : "tent");
  EXPECT_TRUE(contains(to_plot_specification(curve_figure(3)), "\"type\":\"line\""));
  EXPECT_FALSE(contains(to_plot_specification(figure), "\"type\":\"line\""));
}

TEST(PlotFigure, Zero_is_marked_when_values_lie_below_it) {
  PlotFigure figure = curve_figure(3);
  EXPECT_FALSE(contains(to_plot_specification(figure), "\"datum\":0"));
  figure.data.rows[0][1] = -1.0;
  EXPECT_TRUE(contains(to_plot_specification(figure), "\"datum\":0"));
}

}  // namespace
}  // namespace umbrameter
