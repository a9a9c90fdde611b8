// A text that must say several things.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace umbrameter {

inline void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
}

}  // namespace umbrameter
