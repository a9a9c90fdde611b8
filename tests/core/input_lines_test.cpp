#include "core/input_lines.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

namespace umbrameter {
namespace {

// A pipe that holds this text and has ended.
int pipe_with(const std::string& text) {
  std::array<int, 2> ends{};
  EXPECT_EQ(pipe(ends.data()), 0);
  EXPECT_EQ(write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  close(ends[1]);
  return ends[0];
}

TEST(InputLines, Are_returned_in_order_the_empty_ones_too) {
  InputLines lines(pipe_with("one\n\nthree\n"), 100);
  EXPECT_EQ(lines.next(), "one");
  EXPECT_EQ(lines.next(), "");
  EXPECT_EQ(lines.next(), "three");
  EXPECT_EQ(lines.next(), std::nullopt);
  EXPECT_EQ(lines.next(), std::nullopt);
}

TEST(InputLines, The_last_line_needs_no_end) {
  InputLines lines(pipe_with("one\ntwo"), 100);
  EXPECT_EQ(lines.next(), "one");
  EXPECT_EQ(lines.next(), "two");
  EXPECT_EQ(lines.next(), std::nullopt);
}

TEST(InputLines, A_longer_line_is_cut_and_the_next_one_is_whole) {
  InputLines lines(pipe_with("12345\n1234567890\nabc\n1234567"), 5);
  EXPECT_EQ(lines.next(), "12345");
  EXPECT_EQ(lines.next(), "123456");
  EXPECT_EQ(lines.next(), "abc");
  EXPECT_EQ(lines.next(), "123456");
  EXPECT_EQ(lines.next(), std::nullopt);
}

TEST(InputLines, A_descriptor_that_cannot_be_read_has_no_lines) {
  InputLines lines(987, 5);  // not open
  EXPECT_EQ(lines.next(), std::nullopt);
}

}  // namespace
}  // namespace umbrameter
