#include "compare/components.h"

#include <gtest/gtest.h>

#include <string>

namespace umbrameter {
namespace {

// One character a pixel: a digit is its mark, a dot none.
Image<std::uint8_t> marks_of(const std::vector<std::string>& rows) {
  Image<std::uint8_t> marks(static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), 0);
  for (int y = 0; y < marks.height; ++y) {
    for (int x = 0; x < marks.width; ++x) {
      const char c = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
      if (c != '.') marks.at(x, y) = static_cast<std::uint8_t>(c - '0');
    }
  }
  return marks;
}

std::vector<Component> components_of(const std::vector<std::string>& rows) {
  const Image<std::uint8_t> marks = marks_of(rows);
  return find_components(marks, Image<std::uint32_t>(marks.width, marks.height, 2));
}

TEST(Components, Hang_together_over_corners_too) {
  const std::vector<Component> found = components_of({"1..1.",  //
                                                      ".1..1",  //
                                                      "..1..",  //
                                                      ".....",  //
                                                      "11..."});
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].pixels, 3u);
  EXPECT_DOUBLE_EQ(found[0].center_x, 1.0);
  EXPECT_DOUBLE_EQ(found[0].center_y, 1.0);
  EXPECT_EQ(found[1].pixels, 2u);
  EXPECT_EQ(found[2].pixels, 2u);
  EXPECT_DOUBLE_EQ(found[2].center_x, 0.5);
  EXPECT_DOUBLE_EQ(found[2].center_y, 4.0);
}

TEST(Components, Arms_that_meet_below_are_one) {
  EXPECT_EQ(components_of({"1.1.1",  //
                           "1.1.1",  //
                           "11111"})
                .size(),
            1u);
  EXPECT_EQ(components_of({"..111",  //
                           "..1..",  //
                           "111.."})
                .size(),
            1u);
}

TEST(Components, Of_different_marks_do_not_join) {
  const std::vector<Component> found = components_of({"1122",  //
                                                      "1122"});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].mark, 1);
  EXPECT_EQ(found[1].mark, 2);
}

TEST(Components, The_largest_has_the_most_pixels_and_its_share_of_the_weight) {
  Image<std::uint8_t> marks = marks_of({"111.1"});
  Image<std::uint32_t> weights(5, 1, 1);
  weights[4] = 9;
  const ComponentStatistics s = summarize(find_components(marks, weights), 1);
  EXPECT_EQ(s.count, 2u);
  EXPECT_DOUBLE_EQ(s.mean_area, 2.0);
  EXPECT_EQ(s.largest_area, 3u);
  EXPECT_DOUBLE_EQ(s.largest_share, 0.25);
  EXPECT_DOUBLE_EQ(s.largest_x, 1.0);
  EXPECT_DOUBLE_EQ(s.largest_y, 0.0);
}

TEST(Components, Without_a_mark_there_is_none) {
  EXPECT_TRUE(components_of({"....", "...."}).empty());
  EXPECT_EQ(summarize({}, 1).count, 0u);
  EXPECT_EQ(summarize({}, 1).largest_share, 0.0);
}

TEST(Components, All_pixels_marked_are_one) {
  const std::vector<Component> found = components_of({"333", "333"});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].pixels, 6u);
  EXPECT_DOUBLE_EQ(found[0].weight, 12.0);
}

}  // namespace
}  // namespace umbrameter
