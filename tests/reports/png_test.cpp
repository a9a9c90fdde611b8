#include "reports/files/png.h"

#include <gtest/gtest.h>

#include <random>

#include "core/error.h"

namespace umbrameter {
namespace {

// Colours without a pattern, each row `repeats` times.
Image<glm::u8vec3> noise(int width, int height, int repeats) {
  Image<glm::u8vec3> image(width, height);
  std::minstd_rand random(1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y) =
          y % repeats > 0 ? image.at(x, y - 1) : glm::u8vec3(random() >> 8u, random() >> 8u, random() >> 8u);
    }
  }
  return image;
}

// As from_png() returns them: 255 · 257 = 65535.
Image<glm::u16vec4> codes(const Image<glm::u8vec3>& image) {
  Image<glm::u16vec4> result(image.width, image.height);
  for (std::size_t i = 0; i < image.size(); ++i) result[i] = {glm::u16vec3(image[i]) * glm::u16vec3(257), 65535};
  return result;
}

TEST(Png, Pixels_come_back_as_they_went_in) {
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{1, 300}, std::pair{300, 1}, std::pair{97, 61}}) {
    for (const int repeats : {1, 3}) {
      const Image<glm::u8vec3> image = noise(width, height, repeats);
      EXPECT_TRUE(from_png(to_png(image)) == codes(image)) << width << "×" << height << " " << repeats;
    }
  }
}

// PNG specification (third edition), 11.2.1: with at most 256 colours a pixel is one byte, an index.
TEST(Png, Up_to_256_colours_are_a_palette) {
  for (const int colors : {1, 256, 257}) {
    Image<glm::u8vec3> image(64, 64);
    for (std::size_t i = 0; i < image.size(); ++i) {
      const int color = static_cast<int>(i * 997) % colors;
      image[i] = {color & 255, color >> 8, 7};
    }
    const DeflatedImage deflated(image);
    EXPECT_EQ(deflated.palette.size(), colors > 256 ? 0u : 3u * static_cast<unsigned>(colors));
    EXPECT_EQ(to_png(deflated)[25], colors > 256 ? 2 : 3) << "the colour type";
    EXPECT_TRUE(from_png(to_png(deflated)) == codes(image)) << colors;
  }
}

// Section 5.2 and 11.3.2.5 of the specification: the signature, and a chunk that says sRGB.
TEST(Png, Is_marked_as_srgb) {
  const std::string png = to_png(Image<glm::u8vec3>(2, 2));
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_NE(png.find(std::string("\0\0\0\x01sRGB\0", 9)), std::string::npos);
}

// 100 rows of 400 · 3 bytes, and 300 that repeat them.
TEST(Png, Rows_that_repeat_take_next_to_no_bytes) {
  EXPECT_LT(to_png(noise(400, 400, 4)).size(), 1.05 * 100 * 400 * 3);
}

TEST(Png, Of_no_pixels_or_no_png_is_refused) {
  EXPECT_THROW(to_png(Image<glm::u8vec3>()), Error);
  EXPECT_THROW(from_png("not a picture"), Error);
  const std::string png = to_png(noise(97, 61, 1));
  EXPECT_THROW(from_png(png.substr(0, png.size() / 2)), Error);
}

}  // namespace
}  // namespace umbrameter
