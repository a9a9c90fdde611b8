#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "reports/figures/figures.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

using Color = glm::u8vec3;

const ColorScale visibility{ColorMap::visibility, 0.0, 1.0, "visibility [1]"};
const ColorScale error{ColorMap::error, -1.0, 1.0, "raster − truth [1]"};

Color color_of(float value, const ColorScale& scale) { return colorize(Image<float>(1, 1, value), scale)[0]; }

// IEC 61966-2-1.
dvec3 to_linear(const Color& color) {
  dvec3 linear;
  for (int c = 0; c < 3; ++c) {
    const double x = color[c] / 255.0;
    linear[c] = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  }
  return linear;
}

// CIE 1976 L*a*b* of linear sRGB, white point D65.
dvec3 to_lab(const dvec3& rgb) {
  const auto f = [](double t) { return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0; };
  const double x = f((0.4124564 * rgb.x + 0.3575761 * rgb.y + 0.1804375 * rgb.z) / 0.95047);
  const double y = f(0.2126729 * rgb.x + 0.7151522 * rgb.y + 0.0721750 * rgb.z);
  const double z = f((0.0193339 * rgb.x + 0.1191920 * rgb.y + 0.9503041 * rgb.z) / 1.08883);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double lightness(const Color& color) { return to_lab(to_linear(color)).x; }

// How a reader without medium-wave cones sees it: Machado, Oliveira and Fernandes, "A physiologically-based model for
// simulation of color vision deficiency", 2009, deuteranomaly of severity 1.
dvec3 deuteranope_lab(const Color& color) {
  const dvec3 c = to_linear(color);
  const dvec3 seen(0.367322 * c.x + 0.860646 * c.y - 0.227968 * c.z, 0.280085 * c.x + 0.672501 * c.y + 0.047413 * c.z,
                   -0.011820 * c.x + 0.042940 * c.y + 0.968881 * c.z);
  return to_lab(glm::clamp(seen, 0.0, 1.0));
}

TEST(Colors, The_lightness_of_visibility_rises_evenly_from_dark_to_light) {
  EXPECT_LT(lightness(color_of(0.0f, visibility)), 15.0);
  EXPECT_GT(lightness(color_of(1.0f, visibility)), 95.0);
  double least = 100.0;
  double most = 0.0;
  for (int i = 0; i < 32; ++i) {
    const double step = lightness(color_of(static_cast<float>(i + 1) / 32.0f, visibility)) -
                        lightness(color_of(static_cast<float>(i) / 32.0f, visibility));
    least = std::min(least, step);
    most = std::max(most, step);
  }
  EXPECT_GT(least, 1.0);
  EXPECT_LT(most, 3.0 * least);
}

TEST(Colors, No_error_is_nearly_white_and_without_a_hue) {
  const Color zero = color_of(0.0f, error);
  EXPECT_GT(lightness(zero), 94.0);
  EXPECT_EQ(zero.x, zero.y);
  EXPECT_EQ(zero.y, zero.z);
}

TEST(Colors, Errors_get_darker_away_from_zero_alike_on_both_sides) {
  for (int i = 0; i < 32; ++i) {
    const float near = static_cast<float>(i) / 32.0f;
    const float far = static_cast<float>(i + 1) / 32.0f;
    EXPECT_GT(lightness(color_of(near, error)), lightness(color_of(far, error)));
    EXPECT_GT(lightness(color_of(-near, error)), lightness(color_of(-far, error)));
    EXPECT_NEAR(lightness(color_of(far, error)), lightness(color_of(-far, error)), 5.0) << far;
  }
}

TEST(Colors, Too_dark_is_blue_and_too_bright_is_red) {
  for (const float size : {0.2f, 0.6f, 1.0f}) {
    const Color dark = color_of(-size, error);
    const Color bright = color_of(size, error);
    EXPECT_GT(dark.z, dark.x);
    EXPECT_GT(bright.x, bright.z);
  }
}

// 2.3 is just noticeable (Mahy, Van Eycken and Oosterlinck 1994); ten times that is another colour.
TEST(Colors, Readers_without_green_cones_tell_the_sign_of_an_error) {
  for (const float size : {0.25f, 0.5f, 1.0f}) {
    const dvec3 difference = deuteranope_lab(color_of(size, error)) - deuteranope_lab(color_of(-size, error));
    EXPECT_GT(std::hypot(difference.y, difference.z), 23.0) << size;
  }
}

TEST(Colors, Values_beyond_the_scale_take_its_ends_and_no_number_is_magenta) {
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(color_of(7.0f, visibility), color_of(1.0f, visibility));
  EXPECT_EQ(color_of(infinity, error), color_of(1.0f, error));
  EXPECT_EQ(color_of(-infinity, error), color_of(-1.0f, error));
  EXPECT_EQ(color_of(std::numeric_limits<float>::quiet_NaN(), error), Color(255, 0, 255));
  EXPECT_NE(color_of(0.0f, visibility), color_of(1.0f, visibility));
}

TEST(Colors, A_scale_is_shifted_and_stretched) {
  const ColorScale wide{ColorMap::error, -0.5, 0.5, ""};
  EXPECT_EQ(color_of(0.25f, wide), color_of(0.5f, error));
  EXPECT_EQ(color_of(-0.5f, wide), color_of(-1.0f, error));
}

TEST(Colors, An_empty_scale_and_an_empty_image_are_no_trouble) {
  const ColorScale flat{ColorMap::error, 0.3, 0.3, ""};
  EXPECT_EQ(colorize(Image<float>(2, 1, 0.3f), flat).size(), 2u);
  EXPECT_TRUE(colorize(Image<float>(), error).empty());
  EXPECT_TRUE(tone_map(Image<vec3>(), 1.0f).empty());
}

// IEC 61966-2-1: linear 0.214041 is half of the encoded range, 127.5.
TEST(Colors, Linear_colours_become_srgb_after_exposure) {
  EXPECT_EQ(tone_map(Image<vec3>(1, 1, vec3(0.0f, 1.0f, 2.0f)), 1.0f)[0], Color(0, 255, 255));
  EXPECT_NEAR(tone_map(Image<vec3>(1, 1, vec3(0.214041f)), 1.0f)[0].x, 127.5, 0.51);
  EXPECT_NEAR(tone_map(Image<vec3>(1, 1, vec3(0.0535102f)), 4.0f)[0].x, 127.5, 0.51);
  EXPECT_EQ(tone_map(Image<vec3>(1, 1, vec3(-1.0f)), 1.0f)[0], Color(0));
}

// PNG specification, section 5.2 and 11.3: signature, then IHDR with width, height, 8 bits, and for one colour type 3.
TEST(Png, It_is_an_srgb_file_of_the_images_size) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", Image<Color>(300, 2, Color(1, 2, 3)));
  const std::string bytes = text_of(folder / "a.png");
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(bytes.substr(12, 4), "IHDR");
  EXPECT_EQ(bytes.substr(16, 10), std::string("\0\0\x01\x2c\0\0\0\x02\x08\x03", 10));
  EXPECT_NE(bytes.find("sRGB"), std::string::npos);
  write_png(folder / "b.png", Image<Color>(300, 2, Color(1, 2, 3)));
  EXPECT_EQ(text_of(folder / "b.png"), bytes);
}

TEST(Png, An_image_without_pixels_or_a_place_that_is_not_there_is_an_error) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_png(folder / "a.png", Image<Color>()), Error);
  EXPECT_THROW(write_png(folder / "none/a.png", Image<Color>(1, 1)), Error);
  EXPECT_EQ(count_files(folder.path()), 0u);
}

}  // namespace
}  // namespace umbrameter
