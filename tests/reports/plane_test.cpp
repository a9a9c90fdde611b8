#include "reports/page/plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "reports/figures/color_table.h"
#include "reports/page/plane_words.h"

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
  EXPECT_EQ(plane_json(Image<std::uint16_t>(2, 2, 255), 1)["type"], "u8");
  EXPECT_EQ(plane_json(Image<std::uint16_t>(2, 2, 256), 1)["type"], "u16");
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

// PNG specification (third edition), 9.4, on integers: of left 9, above 11 and upper left 10 the gradient is 10, which
// is the upper left; of 9, 11 and 8 it is 12, which is nearest to above.
TEST(Plane, What_a_prediction_misses_is_stored_with_alternating_signs) {
  const auto bytes = [](Words words, Predictor predictor) {
    return residual_bytes({std::move(words)}, 2, 16, predictor);
  };
  const std::string high(4, '\0');
  EXPECT_EQ(bytes({10, 11, 9, 12}, Predictor::paeth), std::string("\24\2\1\4") + high);       // 10, 1, −1, 12 − 10
  EXPECT_EQ(bytes({8, 11, 9, 12}, Predictor::paeth), std::string("\20\6\2\2") + high);        // 8, 3, 1, 12 − 11
  EXPECT_EQ(bytes({8, 11, 9, 12}, Predictor::gradient), std::string("\20\6\2\0", 4) + high);  // the gradient is 12
  EXPECT_EQ(bytes({258, 0}, Predictor::none), std::string("\4\2\0\0", 4)) << "258 is stored as 516";
}

TEST(Plane, A_channel_is_stored_as_its_difference_to_the_one_before) {
  EXPECT_EQ(residual_bytes({{5, 6}, {7, 9}}, 2, 12, Predictor::gradient), std::string("\12\4\2\2\0\0\0\0", 8));
}

TEST(Plane, Half_floats_become_integers_in_the_order_of_their_values) {
  const Words halves = {0xfc00, 0xc000, 0xb800, 0x8001, 0x8000, 0x0000, 0x0001, 0x3800, 0x4000, 0x7c00};
  for (const int bits : {16, 12}) {
    const Words words = ordered(halves, bits);
    EXPECT_TRUE(std::is_sorted(words.begin(), words.end()));
    EXPECT_LT(words.back(), 1 << bits);
  }
}

// The halves of 0.7 and 0.1 have 11 bits, their difference in half floats too: no bit is missed.
TEST(Plane, An_error_that_is_its_difference_takes_no_bits) {
  const Image<float> technique = many(0.7f);
  Image<float> reference = technique;
  for (float& value : reference.pixels) value *= 0.5f;
  const nlohmann::json json = difference_json(reference, technique, reference, 1);
  EXPECT_EQ(json["predictor"], "difference");
  EXPECT_EQ(json["data"], plane_json(Image<std::uint8_t>(2 * technique.width, 1), 1)["data"]);
  EXPECT_NE(difference_json(many(0.3f), technique, many(0.1f), 1)["data"], json["data"]);
}

TEST(Plane, Numbers_of_categories_are_stored_category_by_category) {
  Image<std::uint16_t> numbers(4, 1);
  numbers.pixels = {300, 0, 1, 2};
  Image<std::uint8_t> categories(4, 1);
  categories.pixels = {3, 0, 1, 3};
  Image<std::uint16_t> grouped(3, 1);
  grouped.pixels = {1, 300, 2};
  EXPECT_EQ(plane_json(numbers, categories, 1), plane_json(grouped, 1));
}

TEST(Plane, A_colour_is_one_item_unless_a_plane_has_few_values) {
  EXPECT_EQ(planes_json({many(1.5f), many(2.5f), many(3.5f)}, 1).size(), 1u);
  EXPECT_EQ(planes_json({many(1.5f), Image<float>(301, 1), many(3.5f)}, 1).size(), 3u);
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
