#include "core/lists.h"

#include <gtest/gtest.h>

namespace umbrameter {
namespace {

struct Named {
  std::string name;
  int number = 0;
};

TEST(Lists, A_member_or_a_function_gives_what_is_made_of_each_item) {
  const std::vector<Named> items = {{"a", 1}, {"b", 2}};
  EXPECT_EQ(mapped(items, &Named::name), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(mapped(items, [](const Named& each) { return 2 * each.number; }), (std::vector<int>{2, 4}));
}

TEST(Lists, A_separator_stands_between_all_items_also_empty_ones) {
  EXPECT_EQ(joined(std::vector<std::string>{"", "b", ""}, ", "), ", b, ");
  EXPECT_EQ(joined(std::vector<Named>{{"a"}, {"b"}}, "|", &Named::name), "a|b");
  EXPECT_EQ(joined(std::vector<std::string>(), ", "), "");
}

TEST(Lists, Joined_parts_are_the_text_that_was_split) {
  for (const std::string text : {"", ",", "a", "a,b", ",a,,b,"}) EXPECT_EQ(joined(split(text, ','), ","), text);
  EXPECT_EQ(split("a,,b", ',').size(), 3u);
}

TEST(Lists, A_number_is_the_whole_text_or_none) {
  EXPECT_EQ(parsed<int>("12"), 12);
  EXPECT_EQ(parsed<double>("-1.5e3"), -1500.0);
  for (const char* text : {"", "1 ", " 1", "1x", "x", "1.5", "99999999999"}) EXPECT_FALSE(parsed<int>(text)) << text;
  EXPECT_EQ(parsed_list<int>("84x60", 'x'), (std::vector<int>{84, 60}));
  for (const char* text : {"", "84x", "x60", "84x60y"}) EXPECT_FALSE(parsed_list<int>(text, 'x')) << text;
}

TEST(Lists, One_is_singular) {
  EXPECT_EQ(count_text(0, "cell"), "0 cells");
  EXPECT_EQ(count_text(1, "cell"), "1 cell");
  EXPECT_EQ(count_text(12, "cell"), "12 cells");
}

}  // namespace
}  // namespace umbrameter
