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

// 300 different numbers, too many for a palette, and one more.
Image<float> many(float last, float factor = 1.0f / 512.0f) {
  std::vector<float> values;
  for (int i = 0; i < 300; ++i) values.push_back(factor * static_cast<float>(i));
  values.push_back(last);
  return row(std::move(values));
}

TEST(Plane, Integers_from_0_to_255_are_bytes_a_few_values_a_palette_and_all_else_half_floats) {
  EXPECT_EQ(plane_json(row({0.0f, 1.0f, 255.0f}), 1)["type"], "u8");
  for (const float value : {-1.0f, 0.5f, 256.0f, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_EQ(plane_json(row({1.0f, value}), 1)["type"], "pal") << value;
    EXPECT_EQ(plane_json(many(value), 1)["type"], "f16") << value;
  }
  EXPECT_EQ(plane_json(row({-1.0f, 0.5f, -1.0f}), 1)["palette"], (nlohmann::json{0xbc00, 0x3800}));
  EXPECT_EQ(plane_json(Image<std::uint16_t>(2, 2), 1)["type"], "u16");
  EXPECT_EQ(plane_json(Image<std::uint8_t>(2, 2), 1)["type"], "u8");
}

TEST(Plane, Rounded_shares_are_bytes_unless_one_is_no_share) {
  EXPECT_EQ(plane_json(many(1.0f), 1, PlaneDigits::byte)["type"], "share");
  for (const float value : {-0.1f, 1.1f, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_EQ(plane_json(many(value), 1, PlaneDigits::byte)["type"], "f16") << value;
  }
  EXPECT_EQ(plane_json(row({0.25f}), 1, PlaneDigits::byte)["type"], "pal") << "exact where that is no larger";
}

// Of 7 bits, near 1 the step is 2^-6, and below 1 half of it: the fraction carries into the exponent.
TEST(Plane, Rounded_numbers_are_half_floats_of_seven_bits) {
  const auto packed = [](float value) { return plane_json(many(value), 1, PlaneDigits::few)["data"]; };
  EXPECT_EQ(packed(1.0f + 0.4f / 64.0f), packed(1.0f));
  EXPECT_NE(packed(1.0f + 0.6f / 64.0f), packed(1.0f));
  EXPECT_EQ(packed(1.0f - 0.4f / 128.0f), packed(1.0f));
  EXPECT_NE(packed(std::numeric_limits<float>::infinity()), packed(65504.0f));
}

// A half float has 11 significant bits: near 1 its step is 2^-10.
TEST(Plane, Values_within_half_a_step_of_a_half_float_are_equal) {
  const float step = 1.0f / 1024.0f;
  EXPECT_EQ(plane_json(row({1.0f + 0.4f * step}), 1), plane_json(row({1.0f + 0.1f * step}), 1));
  EXPECT_NE(plane_json(row({1.0f + 0.6f * step}), 1), plane_json(row({1.0f + 0.1f * step}), 1));
  EXPECT_EQ(plane_json(many(1.0f + 0.4f * step), 1)["data"], plane_json(many(1.0f + 0.1f * step), 1)["data"]);
  EXPECT_NE(plane_json(many(1.0f + 0.6f * step), 1)["data"], plane_json(many(1.0f + 0.1f * step), 1)["data"]);
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
