#include "reports/files/markup.h"

#include <gtest/gtest.h>

namespace umbrameter {
namespace {

TEST(Markup, The_five_special_characters_are_escaped) {
  EXPECT_EQ(escape_markup("<a href=\"x\">'&'</a>"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
  EXPECT_EQ(escape_markup(""), "");
}

TEST(Markup, Letters_beyond_ascii_stay) {
  const std::string text = "θ − 5 µm, 光, \xF0\x9F\x92\xA1";
  EXPECT_EQ(escape_markup(text), text);
}

TEST(Markup, Bytes_that_are_no_utf8_become_the_replacement_character) {
  const std::string mark = "\xEF\xBF\xBD";
  EXPECT_EQ(escape_markup("a\xFFz"), "a" + mark + "z");
  EXPECT_EQ(escape_markup("\xC3"), mark);                                   // cut short
  EXPECT_EQ(escape_markup("\xC0\xBC"), mark + mark);                        // an overlong "<"
  EXPECT_EQ(escape_markup("\xED\xA0\x80"), mark + mark + mark);             // a surrogate
  EXPECT_EQ(escape_markup("\xF4\x90\x80\x80"), mark + mark + mark + mark);  // beyond U+10FFFF
  EXPECT_EQ(escape_markup("\xE2\x82<"), mark + mark + "&lt;");              // does not swallow what follows
}

TEST(Markup, Control_characters_that_xml_forbids_do_not_pass) {
  for (int c = 1; c < 0x20; ++c) {
    if (c == '\t' || c == '\n' || c == '\r') continue;
    const std::string text = escape_markup(std::string(1, static_cast<char>(c)));
    EXPECT_EQ(text.find(static_cast<char>(c)), std::string::npos) << c;
  }
  EXPECT_EQ(escape_markup(std::string("a\0b", 3)).find('\0'), std::string::npos);
}

TEST(Markup, Characters_that_hide_or_turn_text_do_not_pass) {
  for (const char* hidden : {"\u202e", "\u2066", "\u200b", "\u200f", "\u2028", "\u061c", "\ufeff", "\u2060"}) {
    EXPECT_EQ(plain_text(std::string("a") + hidden + "b"), "a\uFFFDb");
  }
  EXPECT_EQ(plain_text("\u200d \u2013 \u2070 \u2030"), "\u200d \u2013 \u2070 \u2030");
}

// RFC 4648, section 10.
TEST(Markup, Base64_follows_the_vectors_of_its_standard) {
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) EXPECT_EQ(to_base64(bytes), text);
  EXPECT_EQ(to_base64("\xFF\xFE\xFB"), "//77");
}

TEST(Markup, Characters_are_counted_not_bytes) {
  EXPECT_EQ(count_characters(""), 0u);
  EXPECT_EQ(count_characters("5 µm"), 4u);
  EXPECT_EQ(count_characters("光"), 1u);
}

}  // namespace
}  // namespace umbrameter
