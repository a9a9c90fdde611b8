#include "reports/files/text_layout.h"

#include <gtest/gtest.h>

namespace umbrameter {
namespace {

using Strings = std::vector<std::string>;

TEST(TextLayout, Digits_are_grouped_by_three) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(20'000'000), "20,000,000");
}

TEST(TextLayout, Bytes_have_three_digits_and_a_decimal_unit) {
  EXPECT_EQ(bytes_text(0), "0 B");
  EXPECT_EQ(bytes_text(999), "999 B");
  EXPECT_EQ(bytes_text(1000), "1 kB");
  EXPECT_EQ(bytes_text(4'194'304), "4.19 MB");
  EXPECT_EQ(bytes_text(999'499), "999 kB");
  EXPECT_EQ(bytes_text(999'500), "1 MB");
  EXPECT_EQ(bytes_text(2'147'483'648), "2.15 GB");
}

TEST(TextLayout, What_rounding_leaves_of_a_zero_is_a_zero) {
  EXPECT_EQ(vector_text(1e-17, -0.0, 2.5), "[0, 0, 2.5]");
  EXPECT_EQ(vector_text(1e-7, 0, 2e-7), "[1e-07, 0, 2e-07]");
}

TEST(TextLayout, Long_text_ends_in_dots_and_never_inside_a_character) {
  EXPECT_EQ(shortened("abc", 3), "abc");
  EXPECT_EQ(shortened("abcd", 3), "ab…");
  EXPECT_EQ(shortened("θθθθ", 3), "θθ…");
  EXPECT_EQ(shortened("a\x1b[31m", 9), "a [31m");  // no escape sequence reaches a terminal
  EXPECT_EQ(shortened("a\xc2\x9bm", 9), "a m");    // nor its form of one character, U+009B
}

TEST(TextLayout, Words_are_wrapped_and_long_ones_stand_alone) {
  EXPECT_EQ(wrap_lines("aa bb cc", 5), (Strings{"aa bb", "cc"}));
  EXPECT_EQ(wrap_lines("a  bbbbbbb c", 3), (Strings{"a", "bbbbbbb", "c"}));
  EXPECT_EQ(wrap_lines("θθ θθ\nc", 5), (Strings{"θθ θθ", "c"})) << "characters count, not bytes";
  EXPECT_EQ(wrap_lines("", 5), Strings{});
}

TEST(TextLayout, Columns_are_as_wide_as_their_widest_cell) {
  EXPECT_EQ(aligned({{"a", "1"}, {"θθθ", "22"}, {"b"}}), (Strings{"a    1", "θθθ  22", "b"}));
}

}  // namespace
}  // namespace umbrameter
