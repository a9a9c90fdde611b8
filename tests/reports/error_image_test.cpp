#include "reports/figures/error_image.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "reports/figures/figure_parts.h"
#include "reports/figures/inset.h"

namespace umbrameter {
namespace {

const ColorScale scale{ColorMap::error, -1.0, 1.0, "technique − reference [1]"};

ImageFigure errors_of(int width, int height) {
  ImageFigure figure;
  figure.stem = "error_visibility_sun";
  figure.values = Image<float>(width, height);
  figure.scale = scale;
  return figure;
}

ErrorImage error_of(const std::string& part) {
  ErrorImage error;
  error.shows_errors = true;
  error.part = part;
  return error;
}

FigureStyle column() {
  FigureOptions options;
  options.style = "column";
  return make_figure_style(options);
}

const glm::u8vec3 too_bright = colorize(Image<float>(1, 1, 1.0f), scale)[0];

// 960 pixels in 84 mm, letters of 8 pt: 960 · 8 / (84 · 72/25.4) = 32 pixels and a margin, a tenth of which is 3.
TEST(ErrorImage, One_wrong_pixel_is_a_square_that_can_be_seen_in_a_column) {
  ImageFigure figure = errors_of(960, 540);
  figure.values.at(400, 300) = 1.0f;
  figure.values.at(0, 0) = 0.4f;  // less than half of the scale
  const ErrorImage error = error_of("sun");
  ASSERT_EQ(error_dot(figure, error, column()), 3);
  const Image<glm::u8vec3> pixels = draw(figure, column(), error).images.front().pixels;
  ASSERT_EQ(pixels.width, 960);
  EXPECT_EQ(std::count(pixels.pixels.begin(), pixels.pixels.end(), too_bright), 9);
  EXPECT_EQ(pixels.at(401, 301), too_bright);
  EXPECT_EQ(pixels.at(1, 1), colorize(Image<float>(1, 1, 0.0f), scale)[0]);
  EXPECT_EQ(error_dot(figure, {}, column()), 1) << "no error image";
}

TEST(ErrorImage, A_map_with_errors_everywhere_is_drawn_pixel_by_pixel) {
  ImageFigure figure = errors_of(960, 540);
  for (std::size_t i = 0; i < figure.values.size(); ++i) figure.values[i] = i % 7 == 0 ? 0.0f : 0.01f;
  figure.values.at(400, 300) = 1.0f;
  EXPECT_EQ(error_dot(figure, error_of("ao"), column()), 1);
}

TEST(ErrorImage, The_nearest_wrong_pixel_wins_and_wrong_pixels_keep_their_value) {
  Image<float> values(5, 1);
  values[0] = 1.0f;
  values[3] = -0.75f;
  const Image<float> enlarged = enlarge_errors(values, scale, 5);
  EXPECT_EQ(enlarged.pixels, (std::vector<float>{1.0f, 1.0f, -0.75f, -0.75f, -0.75f}));
  const std::vector<bool> categories = {false, true};
  const Image<std::uint8_t> alone = [] {
    Image<std::uint8_t> image(3, 3);
    image.at(1, 1) = 1;
    return image;
  }();
  EXPECT_EQ(enlarge_errors(alone, categories, 3).pixels, std::vector<std::uint8_t>(9, 1));
  EXPECT_EQ(enlarge_errors(alone, categories, 1), alone);
}

TEST(ErrorImage, The_scene_shows_through_where_nothing_is_wrong_and_full_errors_keep_their_colour) {
  Image<float> values(2, 1);
  values[1] = 1.0f;
  Image<std::uint8_t> backdrop(2, 1, 220);
  const Image<glm::u8vec3> colors = colorize_over(values, scale, backdrop);
  const glm::u8vec3 middle = colorize(Image<float>(1, 1, 0.0f), scale)[0];
  // 220/245 of the scale's middle, which is within a byte of 245.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(colors[0][c], 220.0 / 245.0 * middle[c], 0.5);
  EXPECT_EQ(colors[1], too_bright);
}

// In a grey print only the lightness is left.
TEST(ErrorImage, An_error_beyond_a_third_of_its_scale_is_darker_than_every_backdrop) {
  const auto grey = [](double luminance) { return lightness(glm::u8vec3(backdrop_grey(luminance))); };
  EXPECT_LT(grey(0.0), grey(0.2));
  EXPECT_LT(grey(0.2), grey(1.0));
  EXPECT_EQ(backdrop_grey(-1.0), 255) << "background is white";
  for (const float error : {-1.0f, -0.6f, -0.34f, 0.34f, 0.6f, 1.0f}) {
    for (const double luminance : {0.0, 0.3, 1.0}) {
      const Image<glm::u8vec3> color =
          colorize_over(Image<float>(1, 1, error), scale, Image<std::uint8_t>(1, 1, backdrop_grey(luminance)));
      // 5 steps of CIE L* can be seen side by side.
      EXPECT_LT(lightness(color[0]), grey(0.0) - 5.0) << error << " over " << luminance;
    }
  }
}

TEST(ErrorImage, The_backdrop_takes_the_place_of_correct_pixels_only) {
  ImageFigure figure;
  figure.stem = "class_sun";
  figure.category = Image<std::uint8_t>(640, 360);
  figure.category.at(10, 10) = 1;
  figure.categories = {{"correct", {240, 240, 240}}, {"acne", {213, 94, 0}}};
  ErrorImage error = error_of("sun");
  error.right_category = 0;
  error.wrong_category = {false, true};
  error.backdrop = Image<std::uint8_t>(640, 360, 222);
  const Image<glm::u8vec3> pixels = draw(figure, {}, error).images.front().pixels;
  EXPECT_EQ(pixels.at(0, 0), glm::u8vec3(222));
  EXPECT_EQ(pixels.at(10, 10), glm::u8vec3(213, 94, 0));
}

// The region is 40 × 22 pixels, an eighth of 320 × 180. Each blob fits into one.
TEST(ErrorImage, The_worst_inset_is_the_region_of_most_error_of_its_part) {
  std::vector<ImageFigure> figures = {errors_of(320, 180), errors_of(320, 180), errors_of(320, 180)};
  figures[1].stem = "raster_visibility_sun";
  figures[2].stem = "error_visibility_lamp";
  ErrorImages errors = {
      {figures[0].stem, error_of("sun")}, {figures[1].stem, error_of("sun")}, {figures[2].stem, error_of("lamp")}};
  errors.at("raster_visibility_sun").shows_errors = false;
  const auto fill = [](Image<float>& image, int x, int y, float value) {
    for (int v = 0; v < 5; ++v) {
      for (int u = 0; u < 5; ++u) image.at(x + u, y + v) = value;
    }
  };
  fill(figures[0].values, 20, 30, 0.5f);
  fill(figures[0].values, 200, 100, -0.75f);
  fill(figures[2].values, 300, 5, 1.0f);
  add_worst_insets({figures.begin(), figures.end()}, errors);
  const auto holds = [&](const ImageFigure& figure, int x, int y) {
    const Inset& region = errors.at(figure.stem).insets.at(0);
    return region.width == 40 && region.height == 22 && region.x <= x && region.y <= y && region.x + 40 >= x + 5 &&
           region.y + 22 >= y + 5;
  };
  EXPECT_TRUE(holds(figures[0], 200, 100));
  EXPECT_TRUE(holds(figures[1], 200, 100)) << "the technique's image has the same inset";
  EXPECT_TRUE(holds(figures[2], 300, 5));
  std::vector<ImageFigure> right = {errors_of(320, 180)};
  ErrorImages none = {{right[0].stem, error_of("sun")}};
  add_worst_insets({right[0]}, none);
  EXPECT_TRUE(none.at(right[0].stem).insets.empty()) << "nothing is wrong";
}

TEST(ErrorImage, The_caption_says_what_the_drawing_does) {
  FigureStyle style = column();
  style.insets = {Inset{}};
  std::vector<Figure> figures = {errors_of(960, 540)};
  ImageFigure& figure = std::get<ImageFigure>(figures[0]);
  figure.caption = "Technique − reference.";
  figure.values.at(400, 300) = 1.0f;
  ErrorImages errors = {{figure.stem, error_of("sun")}};
  ErrorImage& error = errors.at(figure.stem);
  error.backdrop = Image<std::uint8_t>(960, 540, 222);
  complete_error_images(figures, errors, style);
  const std::string& caption = figure.caption;
  EXPECT_EQ(caption.find("Technique − reference. Behind it, in light grey"), 0u) << caption;
  EXPECT_NE(caption.find("Inset: the region of most error, 120×67 pixels at ("), std::string::npos) << caption;
  const int dot = error_dot(figure, error, style);
  ASSERT_GT(dot, 1);
  EXPECT_NE(caption.find(std::to_string(dot) + " × " + std::to_string(dot) + " pixels outside of the insets"),
            std::string::npos)
      << caption;
  EXPECT_EQ(draw(figure, style, error).images.size(), 2u);
}

}  // namespace
}  // namespace umbrameter
