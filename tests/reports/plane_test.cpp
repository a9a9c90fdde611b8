#include "reports/page/plane.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "reports/figures/color_table.h"

namespace umbrameter {
namespace {

Image<float> row(std::vector<float> values) {
  Image<float> image(static_cast<int>(values.size()), 1);
  image.pixels = std::move(values);
  return image;
}

TEST(Plane, Integers_from_0_to_255_are_bytes_and_all_else_half_floats) {
  EXPECT_EQ(plane_json(row({0.0f, 1.0f, 255.0f}), 1)["type"], "u8");
  for (const float value : {-1.0f, 0.5f, 256.0f, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_EQ(plane_json(row({1.0f, value}), 1)["type"], "f16") << value;
  }
  EXPECT_EQ(plane_json(Image<std::uint16_t>(2, 2), 1)["type"], "u16");
  EXPECT_EQ(plane_json(Image<std::uint8_t>(2, 2), 1)["type"], "u8");
}

// A half float has 11 significant bits: near 1 its step is 2^-10.
TEST(Plane, Values_within_half_a_step_of_a_half_float_are_equal) {
  const float step = 1.0f / 1024.0f;
  EXPECT_EQ(plane_json(row({1.0f + 0.4f * step}), 1)["data"], plane_json(row({1.0f + 0.1f * step}), 1)["data"]);
  EXPECT_NE(plane_json(row({1.0f + 0.6f * step}), 1)["data"], plane_json(row({1.0f + 0.1f * step}), 1)["data"]);
}

TEST(Plane, A_stride_of_two_keeps_the_even_rows_and_columns) {
  Image<float> image(5, 3);
  for (std::size_t i = 0; i < image.size(); ++i) image[i] = 0.25f + static_cast<float>(i);
  Image<float> expected(3, 2);
  expected.pixels = {0.25f, 2.25f, 4.25f, 10.25f, 12.25f, 14.25f};
  EXPECT_EQ(plane_json(image, 2), plane_json(expected, 1));
}

TEST(ColorTable, The_page_has_the_colours_of_the_figures) {
  const ColorTable table = color_table(ColorMap::error);
  const Image<glm::u8vec3> colors = colorize(row({-1.0f, 0.0f, 1.0f}), {ColorMap::error, -1.0, 1.0, ""});
  EXPECT_EQ(table.front(), colors[0]);
  EXPECT_EQ(table[color_table_size / 2], colors[1]);
  EXPECT_EQ(table.back(), colors[2]);
}

}  // namespace
}  // namespace umbrameter
