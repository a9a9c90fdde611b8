// What a user's word selects among the scenes, cameras or lights of a file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/lists.h"

namespace umbrameter {

/// Equal but for the case of ASCII letters.
inline bool equal_without_case(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

/// Indices of the items that the word selects: those of exactly this name; else those of this name in another case;
/// else the one at this index. Names go first, so that a light named "7" can be selected. More than one is ambiguous,
/// none is unknown.
template <class Named>
std::vector<std::size_t> select_items(const std::vector<Named>& items, const std::string& word) {
  std::vector<std::size_t> exact;
  std::vector<std::size_t> similar;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].name == word) exact.push_back(i);
    if (equal_without_case(items[i].name, word)) similar.push_back(i);
  }
  if (!exact.empty()) return exact;
  if (!similar.empty()) return similar;
  if (const auto index = parsed<std::size_t>(word); index && *index < items.size()) return {*index};
  return {};
}

}  // namespace umbrameter
